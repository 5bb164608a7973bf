#include "kestrel/vision/corner_motion.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

using Variances = Eigen::Matrix<double, 8, 1>;

std::array<Pixel, 4> square(double u, double v) {
  return {{{u, v}, {u + 100, v}, {u + 100, v + 100}, {u, v + 100}}};
}

TEST(CornerMotion, LearnsAConstantSpeedAndCarriesItOn) {
  const MotionOptions options;
  const Variances quiet = Variances::Constant(1e-4);
  CornerMotion motion = first_motion(square(0, 0), quiet, 0, options);
  for (int k = 1; k <= 20; ++k) {
    motion = corrected(predicted(motion, k * 0.04, options), square(3.0 * k, -2.0 * k), quiet);
  }
  const auto ahead = predicted(motion, 21 * 0.04, options).corners();
  EXPECT_NEAR(ahead[0].u, 63, 0.01);  // the pixels' noise
  EXPECT_NEAR(ahead[2].v, 100 - 42, 0.01);
}

TEST(CornerMotion, SightMovesItByTheShareThatTheTextbookSays) {
  // One step of a scalar filter: prior variance p, noise r, gain p / (p + r).
  const MotionOptions options;
  const CornerMotion prior = first_motion(square(10, 10), Variances::Constant(4), 0, options);
  const CornerMotion after = corrected(prior, square(20, 10), Variances::Constant(12));
  EXPECT_NEAR(after.corners()[0].u, 10 + 10 * 4.0 / 16, 1e-12);
  EXPECT_NEAR(after.coordinates[0].covariance(0, 0), 4 - 4 * 4.0 / 16, 1e-12);
}

TEST(CornerMotion, GrowsUncertainAsItsPhysicsSay) {
  MotionOptions options;
  options.acceleration_px_s2 = 1000;
  options.first_speed_px_s = 50;
  const CornerMotion start = first_motion(square(0, 0), Variances::Constant(1), 0, options);
  const double t = 0.2;
  const CornerMotion later = predicted(start, t, options);
  const double expected = 1 + 50 * 50 * t * t + 1000 * 1000 * t * t * t * t / 4;
  EXPECT_NEAR(later.deviation_px(), std::sqrt(expected), 1e-9);
}

TEST(CornerMotion, InnovationsOfItsOwnKindOfMotionHaveTheVarianceItClaims) {
  // Corners that accelerate at random as the model says: the filter must be neither proud nor shy.
  MotionOptions options;
  options.acceleration_px_s2 = 500;
  test::Random random("corner motion");
  const double noise = 0.5;
  const double dt = 0.04;
  double sum = 0;
  int count = 0;
  for (int run = 0; run < 40; ++run) {
    double x = 0;
    double speed = random.normal() * options.first_speed_px_s;
    CornerMotion motion =
        first_motion(square(x, 0), Variances::Constant(noise * noise), 0, options);
    for (int k = 1; k <= 50; ++k) {
      const double a = random.normal() * options.acceleration_px_s2;
      x += speed * dt + a * dt * dt / 2;
      speed += a * dt;
      motion = predicted(motion, k * dt, options);
      const double seen = x + random.normal() * noise;
      const double s = motion.coordinates[0].covariance(0, 0) + noise * noise;
      const double innovation = seen - motion.coordinates[0].mean[0];
      if (k > 1) sum += innovation * innovation / s;  // the first sight had no noise here
      if (k > 1) ++count;
      motion = corrected(motion, square(seen, 0), Variances::Constant(noise * noise));
    }
  }
  // Mean of 1960 squares of unit variance: standard deviation sqrt(2 / 1960) = 0.032; four of them.
  EXPECT_NEAR(sum / count, 1, 0.13);
}

TEST(CornerMotion, GateHoldsTheCornersWithTheirDeviations) {
  CornerMotion motion = first_motion(square(10, 20), Variances::Constant(9), 0, {});
  const PixelBox box = gate(motion, 2);
  EXPECT_DOUBLE_EQ(box.u, 10 - 6);
  EXPECT_DOUBLE_EQ(box.v, 20 - 6);
  EXPECT_DOUBLE_EQ(box.width, 100 + 12);
  EXPECT_DOUBLE_EQ(box.height, 100 + 12);
}

TEST(CornerMotion, TimeThatDoesNotGoOnChangesNothing) {
  const MotionOptions options;
  const CornerMotion motion = first_motion(square(0, 0), Variances::Constant(1), 5, options);
  for (const double stamp : {5.0, 4.0, std::numeric_limits<double>::quiet_NaN()}) {
    const CornerMotion same = predicted(motion, stamp, options);
    EXPECT_EQ(same.stamp_s, 5);
    EXPECT_EQ(same.deviation_px(), motion.deviation_px());
  }
}

TEST(CornerMotion, ForgetsItsSpeedOverALongGap) {
  const MotionOptions options;
  const Variances quiet = Variances::Constant(1e-4);
  CornerMotion motion = first_motion(square(0, 0), quiet, 0, options);
  motion = corrected(predicted(motion, 0.04, options), square(10, 0), quiet);
  EXPECT_NEAR(predicted(motion, 10, options).corners()[0].u, 10, 0.1);
}

TEST(CornerMotion, RefusesOptionsOutOfRange) {
  MotionOptions options;
  options.check();
  options.acceleration_px_s2 = 0;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.first_speed_px_s = -1;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.longest_gap_s = std::numeric_limits<double>::infinity();
  EXPECT_THROW(options.check(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

#include "kestrel/sim/vibration.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

VibrationOptions shaking() {
  VibrationOptions o;
  o.amplitude_rad = {0.002, 0.003, 0.001};
  o.frequency_hz = 20;
  return o;
}

TEST(Vibration, IsNothingByDefault) {
  for (double t = 0; t < 1; t += 0.013) EXPECT_EQ(vibration({}, t), Eigen::Vector3d(0, 0, 0));
}

TEST(Vibration, HasTwoHarmonicsAndNothingElse) {
  const VibrationOptions o = shaking();
  const int n = 1000;
  for (int axis = 0; axis < 3; ++axis) {
    for (int harmonic = 0; harmonic <= 3; ++harmonic) {
      double c = 0, s = 0;
      for (int i = 0; i < n; ++i) {  // one turn
        const double angle = vibration(o, i / (20.0 * n))[axis];
        c += angle * std::cos(2 * M_PI * harmonic * i / n) * 2 / n;
        s += angle * std::sin(2 * M_PI * harmonic * i / n) * 2 / n;
      }
      const double shares[] = {0, 1, 0.5, 0};
      EXPECT_NEAR(std::hypot(c, s), shares[harmonic] * o.amplitude_rad[axis], 1e-12)
          << axis << ' ' << harmonic;
    }
  }
}

TEST(Vibration, DoesNotShakeAllAxesAlike) {
  const VibrationOptions o = shaking();
  const Eigen::Vector3d start = vibration(o, 0);
  EXPECT_NEAR(start.x(), 0, 1e-15);
  EXPECT_GT(std::abs(start.y()), 1e-4);
  EXPECT_GT(std::abs(start.z()), 1e-4);
}

TEST(Vibration, RefusesOptionsOutOfRange) {
  VibrationOptions o = shaking();
  EXPECT_NO_THROW(o.check());
  o.amplitude_rad.x() = 0.5;
  EXPECT_THROW(o.check(), std::invalid_argument);
  o = shaking();
  o.frequency_hz = 0;
  EXPECT_THROW(o.check(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

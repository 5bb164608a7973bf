#include "kestrel/sim/helicopter.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

constexpr double kPeriod = 1.0 / 30;

HelicopterState random_state(test::Random& random) {
  HelicopterState s;
  s.position_m = random.vector3(10);
  s.velocity_m_s = random.vector3(2);
  s.roll = random.uniform(-0.2, 0.2);
  s.pitch = random.uniform(-0.2, 0.2);
  s.yaw = random.uniform(-3, 3);
  s.yaw_rate_rad_s = random.uniform(-0.5, 0.5);
  return s;
}

VelocityCommand random_command(test::Random& random) {
  return {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-1, 1),
          random.uniform(-1, 1)};
}

HelicopterState flown(HelicopterState s, const VelocityCommand& command, int periods) {
  for (int i = 0; i < periods; ++i) s = advanced(s, command, kPeriod);
  return s;
}

void expect_near(const HelicopterState& a, const HelicopterState& b, double tolerance) {
  EXPECT_LT((a.position_m - b.position_m).norm(), tolerance);
  EXPECT_LT((a.velocity_m_s - b.velocity_m_s).norm(), tolerance);
  EXPECT_NEAR(a.roll, b.roll, tolerance);
  EXPECT_NEAR(a.pitch, b.pitch, tolerance);
  EXPECT_NEAR(a.yaw, b.yaw, tolerance);
  EXPECT_NEAR(a.yaw_rate_rad_s, b.yaw_rate_rad_s, tolerance);
}

TEST(Helicopter, HoverStaysPutToTheBit) {
  test::Random random("hover");
  HelicopterState start;
  start.position_m = random.vector3(10);
  start.yaw = random.uniform(-3, 3);
  const HelicopterState end = flown(start, VelocityCommand::hover(), 3000);
  EXPECT_EQ(end.position_m, start.position_m);
  EXPECT_EQ(end.velocity_m_s, start.velocity_m_s);
  EXPECT_EQ(end.yaw, start.yaw);
  EXPECT_EQ(end.roll, 0);
  EXPECT_EQ(end.pitch, 0);
}

// v_i = c (1 - q^i) with q = 1 - h/tau, and the position adds the velocity just updated.
TEST(Helicopter, ClimbAndTurnAreTheirRecursionsClosedForm) {
  const HelicopterOptions o;
  const VelocityCommand command{0, 0, 0.7, -0.4};
  const int periods = 20;
  const int n = periods * o.substeps;
  const double h = kPeriod / o.substeps;
  const auto rate = [&](double c, double tau) { return c * (1 - std::pow(1 - h / tau, n)); };
  const auto way = [&](double c, double tau) {
    const double q = 1 - h / tau;
    return h * c * (n - q * (1 - std::pow(q, n)) / (1 - q));
  };
  const HelicopterState s = flown({}, command, periods);
  EXPECT_NEAR(s.velocity_m_s.z(), rate(0.7, o.tau_z_s), 1e-12);  // rounding of 200 steps
  EXPECT_NEAR(s.position_m.z(), way(0.7, o.tau_z_s), 1e-12);
  EXPECT_NEAR(s.yaw_rate_rad_s, rate(-0.4, o.tau_r_s), 1e-12);
  EXPECT_NEAR(s.yaw, way(-0.4, o.tau_r_s), 1e-12);
}

TEST(Helicopter, FirstSubstepTiltsThenAcceleratesThenMoves) {
  HelicopterOptions o;
  o.substeps = 1;
  const double h = 1.0 / 300;
  const HelicopterState s = advanced({}, {0.5, 0.3, 0, 0}, h, o);
  const double pitch = -h * std::atan(0.5 / (0.5 * 9.81)) / 0.15;
  const double roll = h * std::atan(0.3 / (0.5 * 9.81)) / 0.15;
  EXPECT_DOUBLE_EQ(s.pitch, pitch);
  EXPECT_DOUBLE_EQ(s.roll, roll);
  EXPECT_DOUBLE_EQ(s.velocity_m_s.x(), h * -9.81 * std::tan(pitch));
  EXPECT_DOUBLE_EQ(s.velocity_m_s.y(), h * 9.81 * std::tan(roll));
  EXPECT_DOUBLE_EQ(s.position_m.x(), h * s.velocity_m_s.x());
  EXPECT_DOUBLE_EQ(s.position_m.y(), h * s.velocity_m_s.y());
}

// Small tilts: u/cmd = 1 / (tau_a tau_v s^2 + tau_v s + 1).
double second_order_step(double t, const HelicopterOptions& o) {
  const double wn = 1 / std::sqrt(o.tau_a_s * o.tau_v_s);
  const double zeta = wn * o.tau_v_s / 2;
  const double wd = wn * std::sqrt(1 - zeta * zeta);
  return 1 - std::exp(-zeta * wn * t) * (std::cos(wd * t) + zeta * wn / wd * std::sin(wd * t));
}

TEST(Helicopter, LateralStepIsASecondOrderLoopsAndEulersErrorIsFirstOrder) {
  const double step_m_s = 1e-3;  // tilt 2e-4 rad: the loop's nonlinearity is below 1e-7 of it
  const auto worst = [&](int substeps) {
    HelicopterOptions o;
    o.substeps = substeps;
    HelicopterState s;
    double error = 0;
    for (int k = 1; k <= 90; ++k) {
      s = advanced(s, {0, step_m_s, 0, 0}, kPeriod, o);
      error = std::max(error,
                       std::abs(s.velocity_m_s.y() / step_m_s - second_order_step(k * kPeriod, o)));
    }
    return error;
  };
  EXPECT_LT(worst(10), 0.015);  // h/tau_a = 0.022 of the step, at its steepest
  EXPECT_NEAR(worst(200) / worst(400), 2, 0.05);
  EXPECT_LT(worst(400), 4e-4);
}

TEST(Helicopter, SettlesAtTheCommandInItsHeadingFrameLevel) {
  HelicopterState start;
  start.yaw = 0.8;
  const HelicopterState s = flown(start, {1.2, -0.7, 0.4, 0}, 900);
  EXPECT_NEAR(s.velocity_m_s.x(), std::cos(0.8) * 1.2 + std::sin(0.8) * 0.7, 1e-9);
  EXPECT_NEAR(s.velocity_m_s.y(), std::sin(0.8) * 1.2 - std::cos(0.8) * 0.7, 1e-9);
  EXPECT_NEAR(s.velocity_m_s.z(), 0.4, 1e-9);
  EXPECT_NEAR(s.roll, 0, 1e-9);
  EXPECT_NEAR(s.pitch, 0, 1e-9);
}

TEST(Helicopter, LeftIsTheMirrorImageOfRight) {
  test::Random random("mirror");
  const auto mirrored = [](HelicopterState s) {
    s.position_m.y() *= -1;
    s.velocity_m_s.y() *= -1;
    s.roll *= -1;
    s.yaw *= -1;
    s.yaw_rate_rad_s *= -1;
    return s;
  };
  for (int i = 0; i < 20; ++i) {
    const HelicopterState s = random_state(random);
    const VelocityCommand c = random_command(random);
    const VelocityCommand m{c.forward_m_s, -c.right_m_s, c.down_m_s, -c.yaw_rate_rad_s};
    expect_near(flown(mirrored(s), m, 60), mirrored(flown(s, c, 60)), 1e-12);
  }
}

TEST(Helicopter, NorthIsADirectionLikeAnyOther) {
  test::Random random("north");
  for (int i = 0; i < 20; ++i) {
    const double turn = random.uniform(-3, 3);
    const auto turned = [turn](HelicopterState s) {
      const Eigen::Matrix3d R = rotation_from_vector({0, 0, turn});
      s.position_m = R * s.position_m;
      s.velocity_m_s = R * s.velocity_m_s;
      s.yaw += turn;
      return s;
    };
    const HelicopterState s = random_state(random);
    const VelocityCommand c = random_command(random);
    expect_near(flown(turned(s), c, 60), turned(flown(s, c, 60)), 1e-10);
  }
}

TEST(Helicopter, TiltNeverExceedsItsBoundAndReachesIt) {
  test::Random random("tilt");
  const double bound = HelicopterOptions{}.max_tilt_rad;
  HelicopterState s;
  for (int i = 0; i < 300; ++i) {
    const VelocityCommand c{random.uniform(-50, 50), random.uniform(-50, 50), 0, 0};
    s = advanced(s, c, kPeriod);
    ASSERT_LE(std::abs(s.pitch), bound);
    ASSERT_LE(std::abs(s.roll), bound);
  }
  s = flown({}, {100, 100, 0, 0}, 60);  // 2 s: e^-13 short of the bound
  EXPECT_NEAR(s.pitch, -bound, 1e-5);
  EXPECT_NEAR(s.roll, bound, 1e-5);
}

TEST(Helicopter, PoseTurnsByRollThenPitchThenYaw) {
  test::Random random("pose");
  const HelicopterState s = random_state(random);
  using Eigen::Vector3d;
  const Eigen::Matrix3d R = rotation_from_vector(Vector3d(0, 0, s.yaw)) *
                            rotation_from_vector(Vector3d(0, s.pitch, 0)) *
                            rotation_from_vector(Vector3d(s.roll, 0, 0));
  EXPECT_LT((pose(s).rotation - R).norm(), 1e-14);
  EXPECT_EQ(pose(s).translation, s.position_m);
}

TEST(Helicopter, AttitudeWrapsTheYaw) {
  HelicopterState s;
  s.roll = 0.1;
  s.pitch = -0.2;
  s.yaw = 7;
  EXPECT_EQ(attitude(s).roll, 0.1);
  EXPECT_EQ(attitude(s).pitch, -0.2);
  EXPECT_NEAR(attitude(s).yaw, 7 - 2 * M_PI, 1e-15);
}

TEST(Helicopter, NonsenseIsHoverOrRefused) {
  test::Random random("nonsense");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const HelicopterState s = random_state(random);
  expect_near(advanced(s, {nan, 1, 1, 1}, kPeriod), advanced(s, {}, kPeriod), 0x1p-1000);
  EXPECT_THROW(advanced(s, {}, nan), std::invalid_argument);
  EXPECT_THROW(advanced(s, {}, -1), std::invalid_argument);
  for (const auto member : {&HelicopterOptions::tau_v_s, &HelicopterOptions::tau_a_s,
                            &HelicopterOptions::tau_z_s, &HelicopterOptions::tau_r_s,
                            &HelicopterOptions::max_tilt_rad, &HelicopterOptions::gravity_m_s2}) {
    HelicopterOptions o;
    o.*member = nan;
    EXPECT_THROW(o.check(), std::invalid_argument);
    o.*member = 0;
    EXPECT_THROW(o.check(), std::invalid_argument);
  }
  HelicopterOptions o;
  o.substeps = 0;
  EXPECT_THROW(o.check(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

#include "kestrel/sim/motion_sensor.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

RotorcraftState moving() {
  RotorcraftState s;
  s.velocity_m_s = {1, -2, 0.5};
  s.rate_rad_s = {0.1, 0.2, -0.3};
  s.world_from_body = Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitY()) *
                      Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX());
  return s;
}

TEST(MotionSensor, TellsTheTruthByDefault) {
  MotionSensor sensor({}, 1, 0.01);
  const MeasuredMotion m = sensor.measure(moving());
  EXPECT_NEAR(m.attitude.roll, 0.3, 1e-12);
  EXPECT_NEAR(m.attitude.pitch, -0.2, 1e-12);
  EXPECT_NEAR(m.attitude.yaw, 2.0, 1e-12);
  EXPECT_EQ(m.rate_rad_s, moving().rate_rad_s);
  EXPECT_EQ(m.velocity_m_s, moving().velocity_m_s);
}

// 2 s of memory, 20 000 s: 5 000 independent values, deviations known to 1 %.
TEST(MotionSensor, WandersWithItsDeviationAndMemory) {
  MotionSensorOptions o;
  o.attitude_noise_rad = 0.01;
  o.velocity_noise_m_s = 0.1;
  const double h = 0.1;
  MotionSensor sensor(o, 2, h);
  const int n = 200000;
  double roll = 0, velocity = 0, product = 0, before = 0;
  for (int i = 0; i < n; ++i) {
    const MeasuredMotion m = sensor.measure(moving());
    const double e = m.attitude.roll - 0.3;
    roll += e * e;
    product += e * before;
    before = e;
    velocity += (m.velocity_m_s - moving().velocity_m_s).squaredNorm() / 3;
  }
  EXPECT_NEAR(std::sqrt(roll / n), 0.01, 0.0006);
  EXPECT_NEAR(std::sqrt(velocity / n), 0.1, 0.004);
  EXPECT_NEAR(product / roll, std::exp(-h / 2), 0.005);
}

TEST(MotionSensor, HasOneBiasForEachSeed) {
  MotionSensorOptions o;
  o.attitude_bias_rad = 0.02;
  MotionSensor a(o, 3, 0.01), again(o, 3, 0.01), other(o, 4, 0.01);
  const double first = a.measure(moving()).attitude.roll;
  EXPECT_EQ(a.measure(moving()).attitude.roll, first);
  EXPECT_EQ(again.measure(moving()).attitude.roll, first);
  EXPECT_NE(other.measure(moving()).attitude.roll, first);
  EXPECT_NE(first, 0.3);
  double squares = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const double e = MotionSensor(o, seed, 0.01).measure(moving()).attitude.pitch + 0.2;
    squares += e * e;
  }
  EXPECT_NEAR(std::sqrt(squares / 2000), 0.02, 0.0016);  // five of its deviations, 0.02/sqrt(4000)
}

TEST(MotionSensor, RatesAreNoisyEachByItself) {
  MotionSensorOptions o;
  o.rate_noise_rad_s = 0.05;
  MotionSensor sensor(o, 5, 0.01);
  double squares = 0, product = 0, before = 0;
  for (int i = 0; i < 10000; ++i) {
    const double e = sensor.measure(moving()).rate_rad_s.z() + 0.3;
    squares += e * e;
    product += e * before;
    before = e;
  }
  EXPECT_NEAR(std::sqrt(squares / 10000), 0.05, 0.002);
  EXPECT_NEAR(product / squares, 0, 0.05);
}

TEST(MotionSensor, RefusesOptionsOutOfRange) {
  MotionSensorOptions o;
  o.attitude_noise_rad = -1;
  EXPECT_THROW(MotionSensor(o, 1, 0.01), std::invalid_argument);
  EXPECT_THROW(MotionSensor({}, 1, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

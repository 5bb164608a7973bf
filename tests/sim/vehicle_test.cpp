#include "kestrel/sim/vehicle.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"

#include "support/random.hpp"

namespace kestrel {
namespace {

constexpr double kPeriod_s = 1.0 / 30;

HelicopterState random_start(test::Random& random) {
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
  return VelocityCommand::from_vector({random.uniform(-2, 2), random.uniform(-2, 2),
                                       random.uniform(-1, 1), random.uniform(-0.5, 0.5)});
}

TEST(Vehicle, OfFirstOrderLoopsFliesAsThePlantToTheBit) {
  test::Random random("plant");
  for (int i = 0; i < 10; ++i) {
    HelicopterState s = random_start(random);
    Vehicle vehicle(HelicopterOptions{}, s, 1);
    for (int k = 0; k < 30; ++k) {
      const VelocityCommand command = random_command(random);
      s = advanced(s, command, kPeriod_s);
      vehicle.advance(command, kPeriod_s);
    }
    EXPECT_EQ(vehicle.motion().world_from_body.translation, s.position_m);
    EXPECT_EQ(vehicle.motion().world_from_body.rotation, pose(s).rotation);
    EXPECT_EQ(vehicle.motion().velocity_m_s, s.velocity_m_s);
    EXPECT_EQ(vehicle.measured_attitude().roll, s.roll);
  }
}

// Against differences of poses over the last millisecond: first order in its length.
TEST(Vehicle, KnowsItsRatesAndVelocity) {
  test::Random random("rates");
  const double h = 1e-3;
  for (const VehicleOptions& options : {VehicleOptions(HelicopterOptions{}), VehicleOptions([] {
                                          RotorcraftSystem system;
                                          system.period_s = 1e-3;
                                          return system;
                                        }())}) {
    Vehicle vehicle(options, random_start(random), 1);
    for (int i = 0; i < 20; ++i) {
      const VelocityCommand command = random_command(random);
      for (int k = 0; k < 100; ++k) vehicle.advance(command, h);
      const auto before = vehicle.motion().world_from_body;
      vehicle.advance(command, h);
      const TrueMotion& now = vehicle.motion();
      const Eigen::Matrix3d turn = before.rotation.transpose() * now.world_from_body.rotation;
      EXPECT_LT((rotation_vector(turn) / h - now.rate_rad_s).norm(), 0.02);
      EXPECT_LT(
          ((now.world_from_body.translation - before.translation) / h - now.velocity_m_s).norm(),
          0.02);
    }
  }
}

TEST(Vehicle, AttitudeIsThatOfThePose) {
  test::Random random("attitude");
  for (int i = 0; i < 100; ++i) {
    const double roll = random.uniform(-1.5, 1.5), pitch = random.uniform(-1.5, 1.5),
                 yaw = random.uniform(-3, 3);
    const Attitude a = attitude(Transform<frame::World, frame::Body>{
        rotation_from_rpy(roll, pitch, yaw), Eigen::Vector3d::Zero()});
    EXPECT_NEAR(a.roll, roll, 1e-9);
    EXPECT_NEAR(a.pitch, pitch, 1e-9);
    EXPECT_NEAR(a.yaw, yaw, 1e-9);
  }
}

TEST(Vehicle, StartsAtRestWhereItIsPut) {
  test::Random random("start");
  const HelicopterState start = random_start(random);
  Vehicle vehicle(RotorcraftSystem{}, start, 1);
  EXPECT_EQ(vehicle.motion().world_from_body.translation, start.position_m);
  EXPECT_NEAR(attitude(vehicle.motion().world_from_body).yaw, start.yaw, 1e-12);
  for (int i = 0; i < 300; ++i) vehicle.advance(VelocityCommand::hover(), kPeriod_s);
  EXPECT_LT((vehicle.motion().world_from_body.translation - start.position_m).norm(), 0.05);
}

// Periods that do not divide the time asked for: none is lost, none is flown twice.
TEST(Vehicle, FliesTheTimeItIsTold) {
  RotorcraftSystem system;
  Vehicle in_one(system, {}, 1), in_parts(system, {}, 1);
  const VelocityCommand command{1, 0.5, -0.3, 0.2};
  in_one.advance(command, 3);
  for (int i = 0; i < 90; ++i) in_parts.advance(command, kPeriod_s);
  EXPECT_EQ(in_one.motion().world_from_body.translation,
            in_parts.motion().world_from_body.translation);
}

TEST(Vehicle, ReportsItsAttitudeWithErrorsAndRepeats) {
  RotorcraftSystem system;
  system.sensor.attitude_bias_rad = 0.02;
  system.wind.turbulence_m_s = 5;
  Vehicle a(system, {}, 1), b(system, {}, 1), c(system, {}, 2);
  for (int i = 0; i < 30; ++i) {
    for (Vehicle* each : {&a, &b, &c}) each->advance({1, 0, 0, 0}, kPeriod_s);
  }
  EXPECT_NE(a.measured_attitude().roll, attitude(a.motion().world_from_body).roll);
  EXPECT_EQ(a.motion().world_from_body.translation, b.motion().world_from_body.translation);
  EXPECT_NE(a.motion().world_from_body.translation, c.motion().world_from_body.translation);
}

TEST(Vehicle, TakesNonsenseForHover) {
  Vehicle a(RotorcraftSystem{}, {}, 1), b(RotorcraftSystem{}, {}, 1);
  a.advance({std::nan(""), 0, 0, 0}, 1);
  b.advance(VelocityCommand::hover(), 1);
  EXPECT_EQ(a.motion().world_from_body.translation, b.motion().world_from_body.translation);
}

TEST(Vehicle, RefusesOptionsOutOfRange) {
  RotorcraftSystem system;
  system.period_s = 0.1;
  EXPECT_THROW(Vehicle(system, {}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

#include "kestrel/link/kinematic_vehicle.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

VehicleTruth high_up() {
  VehicleTruth truth;
  truth.position_ned_m.z() = -10;
  return truth;
}

MotionReference wanted(const Eigen::Vector3d& velocity, double yaw_rate) {
  MotionReference reference;
  reference.velocity_ned_m_s = velocity;
  reference.yaw_rate_rad_s = yaw_rate;
  return reference;
}

TEST(KinematicVehicle, FollowsLikeAFirstOrderLag) {
  KinematicVehicle vehicle(high_up());
  const Eigen::Vector3d u(1, -2, 0.5);
  vehicle.move(wanted(u, 0.5), 0.4);
  const double reached = 1 - std::exp(-1);  // after one time constant
  EXPECT_LT((vehicle.truth().velocity_ned_m_s - reached * u).norm(), 1e-12);
  // The integral of the lag: u (t - tau (1 - e^-t/tau)).
  const Eigen::Vector3d way = u * (0.4 - 0.4 * reached);
  EXPECT_LT((vehicle.truth().position_ned_m - Eigen::Vector3d(0, 0, -10) - way).norm(), 1e-12);
  EXPECT_NEAR(vehicle.truth().body_rates_rad_s.z(), 0.5 * (1 - std::exp(-2)), 1e-12);
  EXPECT_NEAR(vehicle.truth().attitude.yaw, 0.5 * (0.4 - 0.2 * (1 - std::exp(-2))), 1e-12);
}

TEST(KinematicVehicle, ManySmallStepsAreOneLargeOne) {
  KinematicVehicle coarse(high_up());
  KinematicVehicle fine(high_up());
  const auto reference = wanted({3, 1, -1}, -0.3);
  coarse.move(reference, 1);
  for (int i = 0; i < 1000; ++i) fine.move(reference, 0.001);
  EXPECT_LT((coarse.truth().position_ned_m - fine.truth().position_ned_m).norm(), 1e-9);
  EXPECT_NEAR(coarse.truth().attitude.yaw, fine.truth().attitude.yaw, 1e-9);
}

TEST(KinematicVehicle, LeansIntoItsAcceleration) {
  VehicleTruth east = high_up();
  east.attitude.yaw = M_PI / 2;
  KinematicVehicle vehicle(east);
  vehicle.move(wanted({0, 1, 0}, 0), 0.01);  // ahead: nose down
  EXPECT_LT(vehicle.truth().attitude.pitch, -0.1);
  EXPECT_NEAR(vehicle.truth().attitude.roll, 0, 1e-9);
  KinematicVehicle aside(east);
  aside.move(wanted({-1, 0, 0}, 0), 0.01);  // to the right: right side down
  EXPECT_GT(aside.truth().attitude.roll, 0.1);
}

TEST(KinematicVehicle, StandsOnTheGround) {
  KinematicVehicle vehicle;
  vehicle.move(wanted({0, 0, 1}, 0), 5);
  EXPECT_EQ(vehicle.truth().position_ned_m.z(), 0);
  EXPECT_TRUE(vehicle.truth().velocity_ned_m_s.isZero(0));
  vehicle.move(wanted({0, 0, -1}, 0), 5);
  EXPECT_LT(vehicle.truth().position_ned_m.z(), -4);
}

TEST(KinematicVehicle, TakesNoStepThatIsNoneAndNoOptionsThatAreNone) {
  KinematicVehicle vehicle(high_up());
  for (const double step_s : {0.0, -1.0, std::nan("")}) vehicle.move(wanted({1, 1, 1}, 1), step_s);
  EXPECT_TRUE(vehicle.truth().velocity_ned_m_s.isZero(0));
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(KinematicVehicle({}, {bad, 1}), std::invalid_argument);
    EXPECT_THROW(KinematicVehicle({}, {1, bad}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace kestrel

#include "kestrel/link/axis_response.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

VehicleMotion at(double north, double east, double down) {
  VehicleMotion motion;
  motion.position_ned_m = {north, east, down};
  return motion;
}

TEST(AxisResponse, TurnsAWayIntoTheHeadingItBeganWith) {
  // Heading east: ahead is east, right is south.
  const Excursion d = excursion(at(1, 2, -3), M_PI / 2, at(0.5, 4, -2), -M_PI + 0.1);
  EXPECT_NEAR(d.forward_m, 2, 1e-12);
  EXPECT_NEAR(d.right_m, 0.5, 1e-12);
  EXPECT_NEAR(d.down_m, 1, 1e-12);
  EXPECT_NEAR(d.yaw_rad, M_PI / 2 + 0.1, 1e-12);
}

TEST(AxisResponse, CommandsOneAxisAlone) {
  EXPECT_EQ(along(MotionAxis::Forward, 2).vector(), Eigen::Vector4d(2, 0, 0, 0));
  EXPECT_EQ(along(MotionAxis::Right, 2).vector(), Eigen::Vector4d(0, 2, 0, 0));
  EXPECT_EQ(along(MotionAxis::Down, 2).vector(), Eigen::Vector4d(0, 0, 2, 0));
  EXPECT_EQ(along(MotionAxis::Yaw, 2).vector(), Eigen::Vector4d(0, 0, 0, 2));
}

TEST(AxisResponse, TellsRightFromWrong) {
  // 0.3 m/s for 2 s: 0.6 m.
  EXPECT_EQ(judge(MotionAxis::Right, 0.3, 2, {0.1, 0.5, 0, 0}), AxisVerdict::AsCommanded);
  EXPECT_EQ(judge(MotionAxis::Right, 0.3, 2, {0.1, -0.5, 0, 0}), AxisVerdict::Opposite);
  EXPECT_EQ(judge(MotionAxis::Right, -0.3, 2, {0.1, -0.5, 0, 0}), AxisVerdict::AsCommanded);
  EXPECT_EQ(judge(MotionAxis::Right, 0.3, 2, {-0.5, 0.1, 0, 0}), AxisVerdict::OtherAxis);
  EXPECT_EQ(judge(MotionAxis::Right, 0.3, 2, {0.05, 0.2, 0, 3}), AxisVerdict::NotMoved);
  EXPECT_EQ(judge(MotionAxis::Right, 0.3, 2, {std::nan(""), std::nan(""), 0, 0}),
            AxisVerdict::NotMoved);
  EXPECT_EQ(judge(MotionAxis::Yaw, 0.3, 2, {9, 9, 9, 0.5}), AxisVerdict::AsCommanded);
  EXPECT_EQ(judge(MotionAxis::Yaw, 0.3, 2, {0, 0, 0, -0.5}), AxisVerdict::Opposite);
}

TEST(AxisResponse, SaysItInPlainWords) {
  EXPECT_EQ(words(MotionAxis::Right, 0.3, 2, {0.1, 0.52, 0, 0}),
            "commanded right 0.30 m/s for 2.0 s: the vehicle moved right 0.52 m");
  EXPECT_EQ(words(MotionAxis::Down, -0.3, 2, {0.1, 0.1, 0.55, 0}),
            "commanded up 0.30 m/s for 2.0 s: the vehicle moved down 0.55 m");
  EXPECT_EQ(words(MotionAxis::Forward, 0.3, 2, {0.01, 0, 0, 0}),
            "commanded forward 0.30 m/s for 2.0 s: the vehicle did not follow (forward 0.01 m)");
  EXPECT_EQ(words(MotionAxis::Yaw, 10 * M_PI / 180, 2, {0, 0, 0, 18 * M_PI / 180}),
            "commanded yaw 10 deg/s for 2.0 s: the vehicle turned right 18 deg");
}

}  // namespace
}  // namespace kestrel

#include "kestrel/ground/flight_scene.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "loop/flight.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

using test::Flight;

constexpr double kRounding = 1e-9;

Flight any_level_flight(test::Random& random) {
  Flight flight;
  flight.ned = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-2, 2)};
  flight.attitude.yaw = random.uniform(-3, 3);
  return flight;
}

// The goal of example_task is flown with the heading 0, squarely: the level frame at the target is
// the world's, but for its origin.
TEST(FlightScene, PlacesTheVehicleWhereItIs) {
  test::Random random("flight scene");
  for (const Mount& mount : {test::forward_camera(), test::down_camera()}) {
    const Task task = test::example_task(mount);
    const auto target = test::target_for(task);
    const LevelTarget level = level_from_target(task.goal, mount);
    EXPECT_LT((level.rotation - target.rotation).norm(), kRounding);
    for (int i = 0; i < 20; ++i) {
      const Flight flight = any_level_flight(random);
      const TargetPose seen = flight.camera(mount).inverse() * target;
      const VehiclePlace place = vehicle_place(seen, mount, level);
      EXPECT_LT((place.position_m - (flight.ned - target.translation)).norm(), kRounding);
      EXPECT_NEAR(place.yaw_rad, flight.attitude.yaw, kRounding);
      const TargetPose back = seen_from(place, mount, level);
      EXPECT_LT((back.translation - seen.translation).norm(), kRounding);
      EXPECT_LT((back.rotation - seen.rotation).norm(), kRounding);
    }
  }
}

TEST(FlightScene, ItsFrameDoesNotFollowTheGoalsHeading) {
  const Mount mount = test::forward_camera();
  const Task task = test::example_task(mount);
  const LevelTarget level = level_from_target(task.goal, mount);
  const TargetPose turned = seen_from({{-2, 0.5, -0.3}, 0.4}, mount, level);
  EXPECT_LT((level_from_target(turned, mount).rotation - level.rotation).norm(), kRounding);
}

TEST(FlightScene, TheTargetIsInThePictureOrNot) {
  Task task = test::example_task(test::forward_camera());
  const LevelTarget level = level_from_target(task.goal, task.body_from_camera);
  EXPECT_TRUE(has_whole_target_in_picture(task));
  // Half of the picture is atan(160 / 300) = 28 degrees; the target's half at 3 m is 9.5 degrees.
  const VehiclePlace square = vehicle_place(task.goal, task.body_from_camera, level);
  for (const double yaw_rad : {-0.25, 0.25}) {
    task.goal = seen_from({square.position_m, yaw_rad}, task.body_from_camera, level);
    EXPECT_TRUE(has_whole_target_in_picture(task)) << yaw_rad;
  }
  for (const double yaw_rad : {-0.5, 0.5, 3.0}) {
    task.goal = seen_from({square.position_m, yaw_rad}, task.body_from_camera, level);
    EXPECT_FALSE(has_whole_target_in_picture(task)) << yaw_rad;
  }
}

TEST(FlightScene, TheSightHoldsTheTargetThatIsSeen) {
  const Task task = test::example_task(test::forward_camera());
  const FlightScene scene = flight_scene(task, task.goal, Attitude{});
  ASSERT_TRUE(scene.vehicle);
  EXPECT_NEAR(scene.vehicle->position_m.x(), -3.3, kRounding) << "3 m, and 0.3 m of the mount";
  EXPECT_LT((scene.target_m[0] - Eigen::Vector3d(0, -0.5, -0.4)).norm(), kRounding);
  // Forward of the vehicle; its left above, its right below.
  EXPECT_GT(scene.sight[0].x(), 0);
  EXPECT_LT(scene.sight[0].y(), 0);
  EXPECT_LT(scene.sight[0].z(), 0);
  EXPECT_GT(scene.sight[2].y(), 0);
  EXPECT_GT(scene.sight[2].z(), 0);
  EXPECT_NEAR(scene.sight[1].y() / scene.sight[1].x(), (320 - 159.5) / 300, kRounding);
  const FlightScene nose_up = flight_scene(task, task.goal, Attitude{0, 0.2, 0});
  EXPECT_LT(nose_up.sight[2].z(), scene.sight[2].z());
  EXPECT_FALSE(flight_scene(task, std::nullopt, std::nullopt).vehicle);
}

TEST(Horizon, LiesWhereLevelDirectionsAppear) {
  const Task task = test::example_task(test::forward_camera());
  const auto level = horizon(task.camera, task.body_from_camera, Attitude{});
  ASSERT_TRUE(level);
  EXPECT_NEAR((*level)[0].v, 119.5, kRounding);
  EXPECT_NEAR((*level)[1].v, 119.5, kRounding);
  const auto nose_up = horizon(task.camera, task.body_from_camera, Attitude{0, 0.1, 0});
  EXPECT_NEAR((*nose_up)[0].v, 119.5 + 300 * std::tan(0.1), kRounding) << "it sinks";
  const auto right_down = horizon(task.camera, task.body_from_camera, Attitude{0.2, 0, 0});
  EXPECT_GT((*right_down)[0].v, (*right_down)[1].v) << "right side down: it rises to the right";
  EXPECT_NEAR(((*right_down)[0].v - (*right_down)[1].v) / 320, std::tan(0.2), kRounding);
  const auto steep = horizon(task.camera, task.body_from_camera, Attitude{1.2, 0, 0});
  EXPECT_EQ((*steep)[1].v, 240);
  const Task down = test::example_task(test::down_camera());
  EXPECT_FALSE(horizon(down.camera, down.body_from_camera, Attitude{}));
}

}  // namespace
}  // namespace kestrel

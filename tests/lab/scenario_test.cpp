#include "kestrel/lab/scenario.hpp"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

Scenario simple() {
  return {"simple",
          square_points(0.2),
          {Eigen::Matrix3d::Identity(), {0, 0, 1}},
          {Eigen::Matrix3d::Identity(), {0, 0, 2}}};
}

TEST(Scenario, StartsWhereTheCameraIsInTheGoalCamera) {
  const GoalFromCamera start{rotation_from_vector({.1, -.2, .7}), {.3, .2, -.1}};
  const Scenario scenario = scenario_from("s", square_points(0.2), simple().goal, start);
  const GoalFromCamera back = scenario.start_in_goal();
  EXPECT_TRUE(back.rotation.isApprox(start.rotation, 1e-14));
  EXPECT_TRUE(back.translation.isApprox(start.translation, 1e-14));
  // A point seen from both cameras is one point.
  const Eigen::Vector3d p(.1, .1, 0);
  EXPECT_TRUE((scenario.goal * p).isApprox(start * (scenario.start * p), 1e-14));
}

TEST(Scenario, SeesPointsWhereTheyAre) {
  const std::vector<Feature> seen = seen_points(simple().start, square_points(0.2));
  ASSERT_EQ(seen.size(), 4u);
  EXPECT_DOUBLE_EQ(seen[1].at.x, .05);
  EXPECT_DOUBLE_EQ(seen[1].at.y, -.05);
  EXPECT_DOUBLE_EQ(seen[1].depth_m, 2);
  const Pixel px = LabCamera{}.to_pixel(seen[1].at);
  EXPECT_DOUBLE_EQ(px.u, 350);
  EXPECT_DOUBLE_EQ(px.v, 210);
}

TEST(Scenario, CheckNamesWhatIsWrong) {
  EXPECT_NO_THROW(simple().check());
  Scenario scenario = simple();
  scenario.points_m.clear();
  EXPECT_THROW(scenario.check(), std::invalid_argument);
  scenario = simple();
  scenario.points_m[2].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(scenario.check(), std::invalid_argument);
  scenario = simple();
  scenario.start.rotation *= 1.01;
  EXPECT_THROW(scenario.check(), std::invalid_argument);
  LabCamera camera;
  camera.focal_px = 0;
  EXPECT_THROW(camera.check(), std::invalid_argument);
}

TEST(Scenario, CentreIsTheMeanOfThePoints) {
  EXPECT_TRUE(centre_of({{0, 0, 0}, {1, 0, 0}, {2, 3, 6}}).isApprox(Eigen::Vector3d(1, 1, 2)));
}

}  // namespace
}  // namespace kestrel

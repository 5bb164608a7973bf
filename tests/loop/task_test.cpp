#include "kestrel/loop/task.hpp"

#include <limits>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"

#include "loop/flight.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// What check says of the example with one thing changed.
template <class Change>
std::string complaint(const Change& change) {
  Task task = test::example_task(test::forward_camera());
  change(task);
  try {
    task.check();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(Task, IsGoodAsItStands) {
  EXPECT_EQ(complaint([](Task&) {}), "");
}

TEST(Task, NamesASizeOutOfRange) {
  for (const double bad : {0.0, -1.0, kNan, kInf}) {
    EXPECT_THAT(complaint([&](Task& t) { t.target_width_m = bad; }),
                StartsWith("target_width_m: must be positive and finite (m), is "));
    EXPECT_THAT(complaint([&](Task& t) { t.target_height_m = bad; }),
                StartsWith("target_height_m: must be positive and finite (m), is "));
  }
}

TEST(Task, RefusesAMountOrGoalThatIsNoRotation) {
  for (const auto& spoil :
       {+[](Eigen::Matrix3d& R) { R.col(0) *= -1; }, +[](Eigen::Matrix3d& R) { R *= 1.001; },
        +[](Eigen::Matrix3d& R) { R(0, 1) += 0.01; }, +[](Eigen::Matrix3d& R) { R.setZero(); },
        +[](Eigen::Matrix3d& R) { R(2, 2) = kNan; }}) {
    EXPECT_THAT(complaint([&](Task& t) { spoil(t.body_from_camera.rotation); }),
                StartsWith("body_from_camera: the rotation is no rotation matrix"));
    EXPECT_THAT(complaint([&](Task& t) { spoil(t.goal.rotation); }),
                StartsWith("goal: the rotation is no rotation matrix"));
  }
  EXPECT_THAT(complaint([](Task& t) { t.body_from_camera.translation.z() = kNan; }),
              StartsWith("body_from_camera: the translation must be finite (m)"));
  EXPECT_THAT(complaint([](Task& t) { t.goal.translation.x() = kInf; }),
              StartsWith("goal: the translation must be finite (m)"));
}

TEST(Task, RefusesAGoalTheCameraCannotSee) {
  EXPECT_THAT(complaint([](Task& t) { t.goal.translation.z() = -3; }),
              StartsWith("goal: the target is not in front of the camera"));
  EXPECT_THAT(complaint([](Task& t) { t.goal.translation.z() = 0; }),
              StartsWith("goal: the target is not in front of the camera"));
  // One edge behind the camera.
  EXPECT_THAT(complaint([](Task& t) {
                t.goal.translation = {0, 0, 0.3};
                t.goal.rotation = rotation_from_vector({0, 1.2, 0});
              }),
              StartsWith("goal: the target is not in front of the camera"));
  EXPECT_THAT(complaint([](Task& t) {
                t.goal.rotation = rotation_from_vector({0, 3, 0});
              }),
              StartsWith("goal: the camera would see the back of the target"));
}

// Forward camera, four freedoms: beyond 13 m of a target of 1 m sideways and yaw look alike.
TEST(Task, RefusesAGoalWithoutAnAnswer) {
  EXPECT_EQ(complaint([](Task& t) { t.goal.translation.z() = 10; }), "");
  EXPECT_THAT(complaint([](Task& t) { t.goal.translation.z() = 30; }),
              StartsWith("goal: from there the corners determine no command"));
  EXPECT_EQ(complaint([](Task& t) {
              t.goal.translation.z() = 30;
              t.servo.freedom = Freedom::Three;
            }),
            "");
}

TEST(Task, NamesTheOptionOfItsParts) {
  EXPECT_THAT(complaint([](Task& t) { t.servo.gain_per_s = 0; }), StartsWith("servo.gain_per_s: "));
  EXPECT_THAT(complaint([](Task& t) { t.limits.speed.down_m_s = kNan; }),
              StartsWith("limits.speed.down_m_s: "));
  EXPECT_THAT(complaint([](Task& t) { t.loss.decay_s = -1; }), StartsWith("loss.decay_s: "));
  EXPECT_THAT(complaint([](Task& t) { t.track.match.ratio = 2; }), StartsWith("track.match.ratio"));
  for (const double bad : {-1.0, kNan, kInf}) {
    EXPECT_THAT(complaint([&](Task& t) { t.pose.corner_noise_px = bad; }),
                StartsWith("pose.corner_noise_px: "));
  }
}

TEST(Task, PutsTheCornersAtTheEdgesOfTheTarget) {
  const auto corners = target_corners(test::example_task(test::forward_camera()));
  EXPECT_EQ(corners[0], Eigen::Vector3d(-0.5, -0.4, 0));
  EXPECT_EQ(corners[1], Eigen::Vector3d(0.5, -0.4, 0));
  EXPECT_EQ(corners[2], Eigen::Vector3d(0.5, 0.4, 0));
  EXPECT_EQ(corners[3], Eigen::Vector3d(-0.5, 0.4, 0));
}

TEST(Task, DesiresTheCornersAsTheGoalSeesThem) {
  Task task = test::example_task(test::forward_camera());
  task.goal.translation = {0.3, -0.2, 2};
  const auto desired = desired_features(task);
  ASSERT_EQ(desired.size(), 4u);
  EXPECT_NEAR(desired[1].at.x, (0.5 + 0.3) / 2, 1e-15);
  EXPECT_NEAR(desired[1].at.y, (-0.4 - 0.2) / 2, 1e-15);
  EXPECT_EQ(desired[1].depth_m, 2);
}

// What the laws are told of a view: the pose it was made from, the displacement to the goal, and a
// homography that takes the goal's points to the measured ones.
TEST(LawInput, TellsThePoseOfAView) {
  test::Random random("law input");
  const Task task = test::example_task(test::forward_camera());
  for (int i = 0; i < 50; ++i) {
    const TargetPose pose{rotation_from_vector(random.rotation_vector(0.6)),
                          random.vector3(0.5) + Eigen::Vector3d(0, 0, 3)};
    const LawInput input = law_input(features(pose, target_corners(task)), task);
    ASSERT_TRUE(input.camera_from_target && input.goal_from_camera &&
                input.camera_from_goal_homography);
    EXPECT_LT((input.camera_from_target->rotation - pose.rotation).norm(), 1e-13);
    EXPECT_LT((input.camera_from_target->translation - pose.translation).norm(), 1e-13);
    const auto goal_from_camera = task.goal * pose.inverse();
    EXPECT_LT((input.goal_from_camera->rotation - goal_from_camera.rotation).norm(), 1e-13);
    EXPECT_LT((input.goal_from_camera->translation - goal_from_camera.translation).norm(), 1e-12);
    for (std::size_t k = 0; k < 4; ++k) {
      const Feature& there = input.desired[k];
      const Eigen::Vector3d m =
          *input.camera_from_goal_homography * Eigen::Vector3d(there.at.x, there.at.y, 1);
      EXPECT_NEAR(m.x() / m.z(), input.measured[k].at.x, 1e-13);
      EXPECT_NEAR(m.y() / m.z(), input.measured[k].at.y, 1e-13);
      EXPECT_NEAR(m.z() * there.depth_m, input.measured[k].depth_m, 1e-12);  // scale is metric
    }
  }
}

TEST(LawInput, HasNoPoseWithoutTheCorners) {
  const Task task = test::example_task(test::forward_camera());
  EXPECT_FALSE(law_input({}, task).camera_from_target);
  EXPECT_EQ(law_input({}, task).desired.size(), 4u);
}

}  // namespace
}  // namespace kestrel

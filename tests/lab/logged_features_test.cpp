#include "kestrel/lab/logged_features.hpp"

#include <gtest/gtest.h>

#include "lab/feature_flight.hpp"

namespace kestrel {
namespace {

// A row's features give decide() what it was given: the same answer.
TEST(LoggedFeatures, AreThoseTheLawWasGiven) {
  const Task task = test::square_task();
  test::Truth truth;
  truth.noise_px = 1;
  const LogFile log = test::feature_flight(task, truth, 3);
  DecisionState memory;
  for (const LogRow& row : log.rows) {
    const Decision again =
        decide(logged_features(row, task), row.attitude, row.stamp_s, memory, task);
    memory = again.next;
    ASSERT_TRUE(again.servo);
    const double difference = (again.wanted.vector() - row.decision->wanted.vector()).norm();
    // Rounding of rotation to vector and back, times the condition of the task (600).
    EXPECT_LT(difference, 1e-9) << row.frame;
  }
}

TEST(LoggedFeatures, LevelledOnesMissTheGoalByTheLoggedError) {
  const Task task = test::square_task();
  const LogFile log = test::feature_flight(task, {}, 2);
  const LogRow& row = log.rows.at(30);
  ASSERT_GT(std::abs(row.attitude->pitch), 0.01);
  const std::vector<Feature> level = logged_levelled_features(row, task);
  const std::vector<Feature> goal = desired_features(task);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(level[i].at.x - goal[i].at.x, row.servo->error[2 * i], 1e-12);
    EXPECT_NEAR(level[i].at.y - goal[i].at.y, row.servo->error[2 * i + 1], 1e-12);
  }
}

TEST(LoggedFeatures, NoneWithoutPoseOrAnswer) {
  const Task task = test::square_task();
  LogRow row = test::feature_flight(task, {}, 1).rows.front();
  ASSERT_FALSE(logged_features(row, task).empty());
  LogRow unseen = row;
  unseen.pose.reset();
  EXPECT_TRUE(logged_features(unseen, task).empty());
  row.servo.reset();
  EXPECT_TRUE(logged_features(row, task).empty());
}

TEST(LoggedFeatures, LeverArmIsLevelledWithTheHelicopter) {
  Task task = test::square_task();
  task.body_from_camera.translation << 0.5, 0, 0;
  LogRow row;
  EXPECT_EQ(levelled_mount(row, task).translation, task.body_from_camera.translation);
  row.attitude = Attitude{0, 0.3, 0};  // nose up: the camera is higher
  const Mount level = levelled_mount(row, task);
  EXPECT_NEAR(level.translation.z(), -0.5 * std::sin(0.3), 1e-12);
  EXPECT_EQ(level.rotation, task.body_from_camera.rotation);
}

}  // namespace
}  // namespace kestrel

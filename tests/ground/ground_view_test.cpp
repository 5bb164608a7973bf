#include "kestrel/ground/ground_view.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "kestrel/geometry/attitude.hpp"

#include "loop/camera_view.hpp"
#include "loop/flight.hpp"

namespace kestrel {
namespace {

using Json = nlohmann::json;

/// A frame taken at the goal, and what the chain makes of it.
class View : public testing::Test {
 protected:
  Frame frame() const {
    Frame f;
    f.index = 3;
    f.stamp_s = 0.1;
    static const cv::Mat painted = test::view(task_.camera, task_.goal);  // once for all tests
    f.gray = painted;
    return f;
  }
  const Task task_ = test::example_task(test::forward_camera());
  const cv::Mat picture_ = test::target_picture(100, 80, 1, 0.8);
  Tracker tracker_{picture_, {0, 0, 100, 80}, task_.track};
};

TEST_F(View, OfAFrameAtTheGoalHasItsCornersThere) {
  const Frame f = frame();
  LoopState state = start(tracker_, f);
  state.track.window = {0, 0, double(f.gray.cols), double(f.gray.rows)};
  const Step s = step(tracker_, f, state, task_);
  const GroundView view = ground_view(f, s, tracker_.model(), task_, 1.5);
  ASSERT_TRUE(view.row.corners);
  for (std::size_t i = 0; i < 4; ++i) {
    // Half a template pixel lies between the centres of corner pixels and the target's edges.
    EXPECT_LT(distance((*view.row.corners)[i], view.goal_corners[i]), 3) << i;
  }
  EXPECT_NE(view.gray.data, f.gray.data) << "the source may write over its own";
  ASSERT_TRUE(view.seen);
  const Json words = Json::parse(json(view));
  EXPECT_EQ(words["frame"], 3);
  EXPECT_EQ(words["status"], "found");
  EXPECT_EQ(words["corners"].size(), 4u);
  EXPECT_EQ(words["errors"].size(), 8u);
  EXPECT_EQ(words["twist"].size(), 6u);
  EXPECT_EQ(words["sent"].size(), 4u);
  EXPECT_EQ(words["chain_ms"], 1.5);
  EXPECT_NEAR(words["distance_m"], task_.goal.translation.norm(), 0.1);
}

TEST_F(View, OfAnEmptyStepIsSoundJson) {
  const GroundView view = ground_view(frame(), Step{}, tracker_.model(), task_, 0);
  const Json words = Json::parse(json(view));
  EXPECT_EQ(words["status"], "lost");
  EXPECT_TRUE(words["corners"].is_null());
  EXPECT_TRUE(words["errors"].is_null());
  EXPECT_TRUE(words["distance_m"].is_null());
}

TEST_F(View, HasTheMatchesThatAgreeAndTheOthersApart) {
  Step seen;
  seen.track.inliers = {{{0, 0}, {10, 20}}, {{1, 1}, {30, 40.5}}};
  seen.track.others.assign(3 * MatchLog::kMost, {{0, 0}, {50, 60}});
  seen.track.keypoints = 900;
  seen.track.matches = int(2 + 3 * MatchLog::kMost);
  GroundView view = ground_view(frame(), seen, tracker_.model(), task_, 0);
  const Json words = Json::parse(json(view));
  EXPECT_EQ(words["inliers"], Json({{10.0, 20.0}, {30.0, 40.5}}));
  EXPECT_EQ(words["others"].size(), MatchLog::kMost) << "a radio carries them";
  EXPECT_EQ(words["others"][0], Json({50.0, 60.0}));
  EXPECT_EQ(words["keypoints"], 900);
  EXPECT_EQ(words["matches"], seen.track.matches);
  EXPECT_EQ(words["agree"], 2);
  EXPECT_TRUE(words["latency_ms"].is_null()) << "nobody said when it was captured";
  view.latency_ms = 41.5;
  EXPECT_EQ(Json::parse(json(view))["latency_ms"], 41.5);
}

// A helicopter that tilts about the camera's centre: levelled, the pose is that before the tilt.
TEST(Levelled, UndoesTheTilt) {
  const Task task = test::example_task(test::forward_camera());
  const Attitude attitude{0.1, -0.2, 0.7};
  const Eigen::Matrix3d R = level_camera_from_camera(task.body_from_camera.rotation, attitude);
  const TargetPose tilted{R.transpose() * task.goal.rotation,
                          R.transpose() * task.goal.translation};
  const TargetPose level = levelled(tilted, attitude, task.body_from_camera);
  EXPECT_LT((level.translation - task.goal.translation).norm(), 1e-12);
  EXPECT_LT((level.rotation - task.goal.rotation).norm(), 1e-12);
  EXPECT_EQ(levelled(tilted, std::nullopt, task.body_from_camera).translation, tilted.translation);
}

}  // namespace
}  // namespace kestrel

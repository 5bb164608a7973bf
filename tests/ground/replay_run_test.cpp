#include "kestrel/ground/replay_run.hpp"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "kestrel/geometry/attitude.hpp"
#include "kestrel/geometry/rotation.hpp"

#include "ground/small_run.hpp"
#include "loop/camera_view.hpp"
#include "loop/flight.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using Json = nlohmann::json;
using test::small_run;

TEST(ReplayRun, TheWholeRunHasARowForEachFrame) {
  const Json all = Json::parse(json(small_run("one", 3)));
  EXPECT_EQ(all["name"], "one");
  EXPECT_EQ(all["frame"], Json({100, 101, 102}));
  EXPECT_EQ(all["found"], Json({true, false, true}));
  EXPECT_EQ(all["errors"][0].size(), 9u);
  EXPECT_NEAR(all["errors"][0][0], 14.283, 1e-3) << "the norm first, five digits of it";
  EXPECT_TRUE(all["errors"][1].is_null());
  EXPECT_EQ(all["time"][0], Json({1.5}));
  EXPECT_TRUE(all["time"][2].is_null());
  EXPECT_TRUE(all["command"][0].is_null()) << "a run without commands";
  for (const char* column : {"stamp_s", "twist", "condition"}) {
    EXPECT_EQ(all[column].size(), 3u) << column;
  }
}

TEST(ReplayRun, AViewIsThatOfTheFlight) {
  const ReplayRun run = small_run("one", 3);
  const cv::Mat picture(60, 80, CV_8UC1, cv::Scalar(9));
  const GroundView view = replay_view(run, 2, picture);
  EXPECT_EQ(view.row.frame, 102);
  EXPECT_EQ(view.gray.cols, 80);
  ASSERT_TRUE(view.seen);
  EXPECT_DOUBLE_EQ(view.seen->translation.norm(), 2);
  // A quarter turn about z takes x to y.
  EXPECT_NEAR((view.seen->rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 0,
              1e-12);
  EXPECT_TRUE(std::isnan(view.goal_corners[0].u)) << "no task, no goal";
  EXPECT_TRUE(Json::parse(json(view))["goal"][0][0].is_null());
  EXPECT_FALSE(replay_view(run, 1, picture).seen);
}

TEST(ReplayRun, KeypointsOfAFrameAreThoseOfItsNumber) {
  ReplayRun run = small_run("one", 3);
  run.matches[102] = {{{1, 2}}, {{3, 4}, {5, 6}}};
  const GroundView view = replay_view(run, 2, {});
  ASSERT_EQ(view.inliers.size(), 1u);
  EXPECT_EQ(view.inliers[0].v, 2);
  EXPECT_EQ(view.others.size(), 2u);
  EXPECT_TRUE(replay_view(run, 0, {}).inliers.empty());
}

TEST(ReplayRun, WithItsTaskItSaysWhereTheVehicleWas) {
  ReplayRun run = small_run("one", 2);
  EXPECT_FALSE(replay_view(run, 0, {}).scene);
  EXPECT_TRUE(Json::parse(json(replay_view(run, 0, {})))["scene"].is_null());
  run.task = test::example_task(test::forward_camera());
  // Seen as from the goal by a helicopter that is pitched: levelled, it is at the goal.
  const Attitude pitched{0, 0.1, 0};
  const Eigen::Matrix3d tilt =
      level_camera_from_camera(run.task->body_from_camera.rotation, pitched).transpose();
  run.log.rows[0].attitude = pitched;
  run.log.rows[0].pose = LoggedPose{tilt * run.task->goal.translation,
                                    rotation_vector(tilt * run.task->goal.rotation), 0.1, false};
  const GroundView view = replay_view(run, 0, {});
  ASSERT_TRUE(view.scene);
  ASSERT_TRUE(view.scene->vehicle);
  EXPECT_LT((view.scene->vehicle->position_m - view.scene->goal.position_m).norm(), 1e-9);
  EXPECT_TRUE(view.horizon);
  EXPECT_FALSE(replay_view(run, 1, {}).scene->vehicle) << "not seen in that frame";
}

TEST(ReplayRun, AGoalIsDrawnWhereTheTaskWantsIt) {
  ReplayRun run = small_run("one", 1);
  run.task = test::example_task(test::forward_camera());
  const GroundView view = replay_view(run, 0, {});
  const Pixel first = run.task->camera.to_pixel(desired_features(*run.task)[0].at);
  EXPECT_EQ(view.goal_corners[0].u, first.u);
  EXPECT_EQ(view.goal_corners[0].v, first.v);
}

TEST(ReplayRun, WithoutAPictureThereIsABlackOneThatHoldsAllOutlines) {
  ReplayRun run = small_run("one", 3);
  EXPECT_EQ(picture_size_px(run), (std::array<int, 2>{640, 480}));
  run.log.rows[0].predicted = {{{0, 0}, {900, 0}, {900, 500}, {0, 1e7}}};
  EXPECT_EQ(picture_size_px(run), (std::array<int, 2>{900, 480})) << "what lies far out is no size";
  const GroundView view = replay_view(run, 0, {});
  EXPECT_EQ(view.gray.cols, 900);
  EXPECT_EQ(int(view.gray.at<unsigned char>(479, 899)), 0);
}

class ChainTimes : public testing::Test {
 protected:
  std::vector<double> of(const std::string& text) {
    std::ofstream(folder_ / "timing.csv") << text;
    return chain_times_ms(folder_ / "timing.csv", small_run("one", 3).log);
  }
  const test::TempFolder folder_;
};

TEST_F(ChainTimes, GoToTheirFrames) {
  const auto times_ms = of("frame,source_ms,chain_ms,record_ms\n102,1,7.5,2\n100,1,6.5,2\n");
  EXPECT_EQ(times_ms[0], 6.5);
  EXPECT_TRUE(std::isnan(times_ms[1]));
  EXPECT_EQ(times_ms[2], 7.5);
}

TEST_F(ChainTimes, ALineWithoutAnEndIsLeftOut) {
  const auto times_ms = of("frame,source_ms,chain_ms,record_ms\n100,1,6.5,2\n101,1");
  EXPECT_EQ(times_ms[0], 6.5);
  EXPECT_TRUE(std::isnan(times_ms[1]));
}

TEST_F(ChainTimes, OfNoFileAreUnknownAndAnotherTableIsAnError) {
  EXPECT_TRUE(std::isnan(chain_times_ms(folder_ / "none.csv", small_run("one", 3).log)[0]));
  EXPECT_THROW(of("a,b\n1,2\n"), std::runtime_error);
}

}  // namespace
}  // namespace kestrel

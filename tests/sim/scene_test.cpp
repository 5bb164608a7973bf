#include "kestrel/sim/scene.hpp"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kestrel {
namespace {

using Eigen::Vector3d;

WallOptions small_wall() {
  WallOptions options;
  options.wall_px_per_m = 10;
  return options;
}

cv::Mat picture() { return cv::Mat(12, 16, CV_8U, cv::Scalar(255)); }

std::string complaint(const Scene& scene) {
  try {
    scene.check();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(Scene, WallFacesSouth) {
  const auto pose = world_from_wall();
  EXPECT_EQ(pose * Vector3d(1, 0, 0), Vector3d(0, 1, 0));  // right is east
  EXPECT_EQ(pose * Vector3d(0, 1, 0), Vector3d(0, 0, 1));  // down is down
  EXPECT_EQ(pose * Vector3d(0, 0, 1), Vector3d(1, 0, 0));  // away is north
}

TEST(Scene, WallStandsOnTheGroundThatBeginsAtItsFoot) {
  const WallOptions options = small_wall();
  const Scene scene = wall_scene(picture(), options);
  ASSERT_EQ(scene.planes.size(), 3u);
  const TexturedPlane& floor = scene.planes[0];
  const TexturedPlane& wall = scene.planes[1];
  const Vector3d foot = wall.world_from_target * Vector3d(0, wall.height_m / 2, 0);
  EXPECT_LT((foot - Vector3d(0, 0, options.ground_below_m)).norm(), 1e-12);
  const Vector3d edge = floor.world_from_target * Vector3d(0, -floor.height_m / 2, 0);
  EXPECT_LT((edge - foot).norm(), 1e-12);
  const Vector3d up = floor.world_from_target.rotation * Vector3d(0, 0, -1);
  EXPECT_EQ(up, Vector3d(0, 0, -1));  // its front is up
  EXPECT_LT(rotation_defect(floor.world_from_target.rotation), 1e-15);
}

TEST(Scene, PosterIsInFrontAtTheOrigin) {
  const Scene scene = wall_scene(picture(), small_wall());
  const TexturedPlane& target = scene.planes.back();
  EXPECT_EQ(target.texture.size(), cv::Size(16, 12));
  EXPECT_EQ(target.width_m, 2.0);
  EXPECT_EQ(target.height_m, 1.5);
  EXPECT_EQ(target.world_from_target.translation, Vector3d(0, 0, 0));
}

TEST(Scene, NamesThePlaneThatIsWrong) {
  const Scene good = wall_scene(picture(), small_wall());
  EXPECT_EQ(complaint(good), "");
  Scene bad = good;
  bad.planes[1].texture = cv::Mat();
  EXPECT_THAT(complaint(bad), testing::HasSubstr("plane 1 of the scene: the texture"));
  bad = good;
  bad.planes[2].texture = cv::Mat(4, 4, CV_8UC3);
  EXPECT_THAT(complaint(bad), testing::HasSubstr("plane 2 of the scene: the texture"));
  bad = good;
  bad.planes[0].width_m = 0;
  EXPECT_THAT(complaint(bad), testing::HasSubstr("the size"));
  bad = good;
  bad.planes[0].world_from_target.rotation *= -1;
  EXPECT_THAT(complaint(bad), testing::HasSubstr("no rotation"));
  bad = good;
  bad.planes[0].world_from_target.translation.x() = std::nan("");
  EXPECT_THAT(complaint(bad), testing::HasSubstr("the position"));
  bad = good;
  bad.background_grey = 256;
  EXPECT_THAT(complaint(bad), testing::HasSubstr("background_grey"));
}

TEST(Scene, RefusesAWallWithoutSize) {
  for (const auto member :
       {&WallOptions::poster_width_m, &WallOptions::poster_height_m, &WallOptions::wall_width_m,
        &WallOptions::wall_height_m, &WallOptions::ground_depth_m, &WallOptions::wall_px_per_m}) {
    WallOptions options;
    options.*member = 0;
    EXPECT_THROW(options.check(), std::invalid_argument);
    options.*member = std::nan("");
    EXPECT_THROW(wall_scene(picture(), options), std::invalid_argument);
  }
}

TEST(Scene, PlanesMoveWhenTheyAreTold) {
  PlaneMotion m;
  EXPECT_EQ(offset(m, 100), Vector3d(0, 0, 0));
  m.velocity_m_s = {0, 0.5, 0};
  m.start_s = 2;
  m.stop_s = 6;
  m.sway_m = {0, 0, 0.2};
  m.sway_period_s = 4;
  EXPECT_EQ(offset(m, 1), Vector3d(0, 0, 0));
  EXPECT_LT((offset(m, 3) - Vector3d(0, 0.5, 0.2)).norm(), 1e-12);
  EXPECT_LT((offset(m, 9) - Vector3d(0, 2, 0)).norm(), 1e-12);
  m.from_s = 1;
  m.until_s = 3;
  EXPECT_FALSE(m.is_there(0.9));
  EXPECT_TRUE(m.is_there(1));
  EXPECT_FALSE(m.is_there(3));
  m.sway_period_s = 0;
  EXPECT_THROW(m.check(), std::invalid_argument);
}

TEST(Scene, TargetIsTheLastPlaneUnlessSaid) {
  Scene s = wall_scene(cv::Mat(48, 64, CV_8U, cv::Scalar(9)));
  EXPECT_EQ(&s.target_plane(), &s.planes.back());
  s.target = 1;
  EXPECT_EQ(&s.target_plane(), &s.planes[1]);
  s.target = 7;
  EXPECT_THROW(s.check(), std::invalid_argument);
  EXPECT_THROW(Scene().target_plane(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

#include "kestrel/sim/visibility.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "kestrel/sim/texture.hpp"
#include "kestrel/sim/world.hpp"

namespace kestrel {
namespace {

Scene poster_scene() { return wall_scene(cv::Mat(16, 16, CV_8U, cv::Scalar(99))); }

/// A camera south of the target that looks north.
CameraAt camera_at(double north_m, double east_m = 0, double time_s = 0) {
  return {time_s, {forward_mount().rotation, {north_m, east_m, 0}}};
}

/// A rectangle that faces south.
TexturedPlane sheet(double width_m, double north_m, double east_m) {
  TexturedPlane plane{cv::Mat(16, 16, CV_8U, cv::Scalar(0)), width_m, 10, world_from_wall()};
  plane.world_from_target.translation << north_m, east_m, 0;
  return plane;
}

double share(const Scene& scene, const CameraAt& at) {
  return visible_share(scene, default_camera(), at);
}

TEST(Visibility, IsAllOfATargetInFrontAndNothingFromBehind) {
  EXPECT_EQ(share(poster_scene(), camera_at(-5)), 1);
  EXPECT_EQ(share(poster_scene(), camera_at(5)), 0);
}

// The image of 640 px is 5.33 m wide at 5 m: with the camera 2.667 m to the east, its left border
// goes through the middle of the target.
TEST(Visibility, CountsWhatLiesInTheImage) {
  EXPECT_EQ(share(poster_scene(), camera_at(-5, 640 * 5.0 / 600 / 2)), 0.5);
  EXPECT_EQ(share(poster_scene(), camera_at(-5, 4)), 0);
}

TEST(Visibility, CountsWhatNothingHides) {
  Scene scene = poster_scene();
  scene.target = scene.planes.size() - 1;
  scene.planes.push_back(sheet(2, -2.5, 1));  // its left edge in the middle of the view
  EXPECT_EQ(share(scene, camera_at(-5)), 0.5);
  scene.planes.back().opacity = 0.4;  // a shadow
  EXPECT_EQ(share(scene, camera_at(-5)), 1);
  scene.planes.back().opacity = 1;
  scene.planes.back().motion.until_s = 3;
  EXPECT_EQ(share(scene, camera_at(-5, 0, 2.9)), 0.5);
  EXPECT_EQ(share(scene, camera_at(-5, 0, 3)), 1);
  scene.planes.back().motion = {};
  scene.planes.back().motion.velocity_m_s << 0, -1, 0;  // it comes from the east
  EXPECT_EQ(share(scene, camera_at(-5, 0, 1)), 0);
}

TEST(Visibility, WantsATarget) { EXPECT_THROW(share({}, camera_at(-5)), std::invalid_argument); }

}  // namespace
}  // namespace kestrel

#include "kestrel/sim/shutter.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/sim/texture.hpp"
#include "kestrel/sim/world.hpp"

namespace kestrel {
namespace {

Camera small_camera() {
  CameraParameters p;
  p.width = 160;
  p.height = 120;
  p.px = p.py = 150;
  p.u0 = 79.5;
  p.v0 = 59.5;
  return Camera(p);
}

CameraInFlight hovering_at_five() {
  CameraInFlight motion;
  motion.vehicle.world_from_body.translation = {-5, 0, 0};
  motion.body_from_camera = forward_mount();
  return motion;
}

Scene poster_scene() {
  Scene scene;
  scene.planes.push_back({poster(256, 192, 1), 6.0, 4.5, world_from_wall()});
  return scene;
}

const Renderer& poster_renderer() {
  static const Renderer it(poster_scene(), small_camera());
  return it;
}

TEST(Shutter, TakesOneViewOfWhatStandsStill) {
  const Shot shot_of = shot(hovering_at_five(), 1.0, poster_renderer(), {0.01, 0.02});
  ASSERT_EQ(shot_of.size(), 1u);
  ASSERT_EQ(shot_of[0].during.size(), 1u);
  EXPECT_EQ(shot_of[0].during[0].world_from_camera.translation, Eigen::Vector3d(-5, 0, 0));
}

TEST(Shutter, ViewsAreSpreadOverTheExposure) {
  CameraInFlight motion = hovering_at_five();
  motion.vehicle.rate_rad_s = {0, 0, 1};
  const ShutterOptions options{0.02, 0, 0.5, 100};
  const Shot shot_of = shot(motion, 1.0, poster_renderer(), options);
  const auto& views = shot_of.at(0).during;
  // 150 px/rad, 1 rad/s, 20 ms: 3 px in the middle, (1 + (80/150)^2) as much at the side.
  EXPECT_EQ(views.size(), 8u);
  double mean_s = 0;
  for (const CameraAt& view : views) mean_s += view.time_s / double(views.size());
  EXPECT_NEAR(mean_s, 1.0, 1e-12);
  EXPECT_NEAR(views.back().time_s - views.front().time_s, 0.02 * 7 / 8, 1e-12);
  const Eigen::Matrix3d turn = views.front().world_from_camera.rotation.transpose() *
                               views.back().world_from_camera.rotation;
  EXPECT_NEAR(rotation_vector(turn).norm(), 0.02 * 7 / 8, 1e-12);
}

TEST(Shutter, RowsAreReadOneAfterTheOther) {
  CameraInFlight motion = hovering_at_five();
  motion.vehicle.velocity_m_s = {0, 3, 0};
  const Shot bands = shot(motion, 0, poster_renderer(), {0, 0.03, 0.28, 12});
  ASSERT_EQ(bands.size(), 10u);  // 3 m/s at 5 m, 150 px, 30 ms: 2.7 px
  EXPECT_EQ(bands.front().first_row, 0);
  double before = -1;
  for (const Band& band : bands) {
    EXPECT_GT(band.during[0].world_from_camera.translation.y(), before);
    before = band.during[0].world_from_camera.translation.y();
  }
  EXPECT_NEAR(bands[4].during[0].time_s, -bands[5].during[0].time_s, 1e-12);
}

// A turn of 1 rad/s for 20 ms is 3 px: a view blurred by a box of 3 px along the rows.
TEST(Shutter, BlursAsTheMotionGoes) {
  CameraInFlight motion = hovering_at_five();
  const Renderer& renderer = poster_renderer();
  const cv::Mat sharp = renderer.expose(shot(motion, 0, renderer, {}));
  motion.vehicle.rate_rad_s = {0, 0, 1};
  const cv::Mat turned = renderer.expose(shot(motion, 0, renderer, {0.02, 0, 0.1, 100}));
  cv::Mat boxed;
  cv::blur(sharp, boxed, {3, 1});
  const cv::Rect middle(50, 40, 60, 40);
  const double to_box = cv::norm(turned(middle), boxed(middle), cv::NORM_L1) / middle.area();
  const double to_sharp = cv::norm(turned(middle), sharp(middle), cv::NORM_L1) / middle.area();
  EXPECT_LT(to_box, 1.0);
  EXPECT_GT(to_sharp, 3 * to_box);
}

// Flying straight at a wall moves its middle nowhere and its corners outwards; the same speed
// before an empty sky moves nothing that is seen.
TEST(Shutter, CountsWhatIsSeenToMove) {
  CameraInFlight motion = hovering_at_five();
  motion.vehicle.velocity_m_s = {5, 0, 0};
  const ShutterOptions options{0.02, 0, 0.1, 100};
  // 100 px from the middle, 5 m away, 0.1 m nearer in the end: 2 px.
  EXPECT_NEAR(double(shot(motion, 0, poster_renderer(), options)[0].during.size()), 20, 1);
  const Renderer sky(Scene{}, small_camera());
  EXPECT_EQ(shot(motion, 0, sky, options)[0].during.size(), 1u);
}

TEST(Shutter, ShakesWithTheRotor) {
  CameraInFlight motion = hovering_at_five();
  motion.vibration.amplitude_rad = {0.002, 0.002, 0.002};
  const CameraAt a = camera_at(motion, 0, 0.005);
  const Eigen::Vector3d turn =
      rotation_vector(motion.body_from_camera.rotation * a.world_from_camera.rotation.transpose());
  EXPECT_NEAR(turn.norm(), vibration(motion.vibration, 0.005).norm(), 1e-9);
  EXPECT_GT(shot(motion, 0, poster_renderer(), {0.01, 0, 0.1, 50})[0].during.size(), 3u);
}

TEST(Shutter, RefusesOptionsOutOfRange) {
  EXPECT_THROW((ShutterOptions{-1, 0}.check()), std::invalid_argument);
  EXPECT_THROW((ShutterOptions{0, 0, 0}.check()), std::invalid_argument);
  EXPECT_THROW((ShutterOptions{0, 0, 1, 0}.check()), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

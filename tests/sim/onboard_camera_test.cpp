#include "kestrel/sim/onboard_camera.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "kestrel/sim/texture.hpp"
#include "kestrel/sim/world.hpp"

namespace kestrel {
namespace {

Camera small_camera() {
  CameraParameters p;
  p.px = p.py = 150;
  p.u0 = 79.5;
  p.v0 = 59.5;
  p.width = 160;
  p.height = 120;
  return Camera(p);
}

OnboardCameraOptions some_options() {
  OnboardCameraOptions options{small_camera(), forward_mount(), {}, 5};
  options.imaging.noise_grey = 2;
  options.imaging.drop_share = 0.3;
  return options;
}

Scene some_scene() {
  WallOptions wall;
  wall.wall_px_per_m = 20;  // coarse: what it looks like is not looked at
  return wall_scene(poster(200, 150, 1), wall);
}

TrueMotion at(double north_m) {
  TrueMotion motion;
  motion.world_from_body.rotation.setIdentity();
  motion.world_from_body.translation = {north_m, 0, 0};
  return motion;
}

double difference(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF); }

TEST(OnboardCamera, LooksFromWhereTheVehicleIsTheSameWayEachTime) {
  const OnboardCamera camera(some_scene(), some_options());
  const Frame frame = camera.look(at(-5), 7, 7 / 30.0);
  EXPECT_EQ(frame.index, 7);
  EXPECT_EQ(frame.stamp_s, 7 / 30.0);
  EXPECT_FALSE(frame.attitude);
  EXPECT_EQ(frame.gray.size(), cv::Size(160, 120));
  EXPECT_EQ(difference(frame.gray, camera.look(at(-5), 7, 7 / 30.0).gray), 0);
  EXPECT_GT(difference(frame.gray, camera.look(at(-4), 7, 7 / 30.0).gray), 30);  // nearer
  EXPECT_GT(difference(frame.gray, camera.look(at(-5), 8, 7 / 30.0).gray), 0);   // other noise
}

// The world in lockstep shows what this camera shows from where the vehicle is.
TEST(OnboardCamera, IsTheCameraOfTheWorld) {
  WorldOptions options;
  const OnboardCameraOptions mine = some_options();
  options.camera = mine.camera;
  options.imaging = mine.imaging;
  options.seed = mine.seed;
  World world(some_scene(), options);
  const OnboardCamera camera(some_scene(), mine);
  for (int i = 0; i < 4; ++i) {
    const auto frame = world.next();
    ASSERT_TRUE(frame);
    world.send({0.5, 0.2, 0, 0.1}, frame->stamp_s);
    EXPECT_FALSE(camera.drops(frame->index));
    const Frame same = camera.look(world.motion(), frame->index, frame->stamp_s);
    EXPECT_EQ(difference(frame->gray, same.gray), 0) << frame->index;
  }
}

TEST(OnboardCamera, DropsTheShareItIsToldButNeverTheFirst) {
  const OnboardCamera camera(some_scene(), some_options());
  EXPECT_FALSE(camera.drops(0));
  int dropped = 0;
  for (int k = 1; k <= 2000; ++k) dropped += camera.drops(k) ? 1 : 0;
  // Binomial: 600 of 2000 with a standard deviation of 20.5; five of these.
  EXPECT_NEAR(dropped, 600, 103);
}

TEST(OnboardCamera, MotionIsSeenAsBlur) {
  OnboardCameraOptions options = some_options();
  options.imaging.noise_grey = 0;
  options.imaging.shutter.exposure_s = 0.05;
  const OnboardCamera camera(some_scene(), options);
  TrueMotion turning = at(-5);
  const cv::Mat sharp = camera.look(turning, 0, 0).gray;
  turning.rate_rad_s = {0, 0, 1};
  const cv::Mat blurred = camera.look(turning, 0, 0).gray;
  cv::Scalar mean, sharp_deviation, blurred_deviation;
  cv::meanStdDev(sharp, mean, sharp_deviation);
  cv::meanStdDev(blurred, mean, blurred_deviation);
  EXPECT_LT(blurred_deviation[0], 0.9 * sharp_deviation[0]);
}

TEST(ImagingOptions, NameWhatIsOutOfRange) {
  OnboardCameraOptions options = some_options();
  options.imaging.drop_share = 1;
  EXPECT_THROW(OnboardCamera(some_scene(), options), std::invalid_argument);
  options = some_options();
  options.imaging.latency_s = -1;
  EXPECT_THROW(OnboardCamera(some_scene(), options), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

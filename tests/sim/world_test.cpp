#include "kestrel/sim/world.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "kestrel/sim/texture.hpp"

namespace kestrel {
namespace {

using Eigen::Vector3d;

const Scene& scene() {
  static const Scene kScene = [] {
    Scene s;
    s.planes.push_back({poster(128, 96, 1), 2.0, 1.5, world_from_wall()});
    return s;
  }();
  return kScene;
}

WorldOptions small_world(std::int64_t frames) {
  CameraParameters p;
  p.width = 64;
  p.height = 48;
  p.px = p.py = 60;
  p.u0 = 31.5;
  p.v0 = 23.5;
  WorldOptions options;
  options.camera = Camera(p);
  options.frames = frames;
  return options;
}

TEST(World, CountsAndStampsItsFramesThenEnds) {
  WorldOptions options = small_world(4);
  options.rate_hz = 25;
  World world(scene(), options);
  EXPECT_EQ(world.frame_count(), 4);
  for (int k = 0; k < 4; ++k) {
    const auto frame = world.next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->index, k);
    EXPECT_EQ(frame->stamp_s, k / 25.0);
    EXPECT_EQ(frame->gray.size(), cv::Size(64, 48));
    EXPECT_EQ(frame->gray.type(), CV_8UC1);
    world.send({1, 0, 0, 0}, frame->stamp_s);
  }
  const Vector3d last = world.motion().world_from_body.translation;
  EXPECT_FALSE(world.next());
  EXPECT_FALSE(world.next());
  EXPECT_EQ(world.motion().world_from_body.translation, last);
  EXPECT_TRUE(world.skipped().empty());
}

TEST(World, WithoutAnEndWhenNoneIsAskedFor) {
  WorldOptions options = small_world(0);
  EXPECT_FALSE(World(scene(), options).next());
  options.frames.reset();
  World world(scene(), options);
  EXPECT_FALSE(world.frame_count());
  for (int k = 0; k < 5; ++k) EXPECT_TRUE(world.next());
}

TEST(World, FirstFrameShowsTheStartAndACommandMovesTheNext) {
  const WorldOptions options = small_world(10);
  World world(scene(), options);
  world.send({0, 0, 1, 0}, 0);
  world.next();
  EXPECT_EQ(world.motion().world_from_body.translation, options.start.position_m);
  world.next();
  const HelicopterState expected = advanced(options.start, {0, 0, 1, 0}, 1.0 / 30);
  EXPECT_EQ(world.motion().world_from_body.translation, expected.position_m);
  EXPECT_GT(world.motion().world_from_body.translation.z(), options.start.position_m.z());
}

TEST(World, HoversWhenNoCommandArrivesForHalfASecond) {
  WorldOptions options = small_world(60);
  World world(scene(), options);
  world.next();
  world.send({1, 0.5, 0.2, 0.1}, 0);
  HelicopterState expected = options.start;
  for (int k = 1; k < 60; ++k) {
    world.next();
    // The period from frame k - 1 to k; 15 periods are half a second.
    const bool fresh = k - 1 < 15;
    expected =
        advanced(expected, fresh ? VelocityCommand{1, 0.5, 0.2, 0.1} : VelocityCommand{}, 1.0 / 30);
    ASSERT_EQ(world.motion().world_from_body.translation, expected.position_m) << "frame " << k;
  }
  EXPECT_LT(world.motion().velocity_m_s.norm(), 0.05);
}

TEST(World, CommandThatIsNotANumberIsHoverAndCounted) {
  World world(scene(), small_world(90));
  world.next();
  world.send({1, 0, 0, 0}, 0);
  world.next();
  world.send({std::numeric_limits<double>::quiet_NaN(), 0, 0, 0}, 0);
  EXPECT_EQ(world.failures(), 1);
  const HelicopterState before = advanced(small_world(90).start, {1, 0, 0, 0}, 1.0 / 30);
  world.next();
  EXPECT_EQ(world.motion().world_from_body.translation, advanced(before, {}, 1.0 / 30).position_m);
}

TEST(World, FrameIsTheViewFromWhereTheCameraIs) {
  WorldOptions options = small_world(10);
  options.body_from_camera.translation << 0.3, 0, 0.1;
  options.start.yaw = 0.2;
  World world(scene(), options);
  std::optional<Frame> frame;
  for (int k = 0; k < 6; ++k) {
    frame = world.next();
    world.send({1, 0.5, -0.3, 0.2}, 0);
  }
  HelicopterState expected = options.start;
  for (int k = 0; k < 5; ++k) expected = advanced(expected, {1, 0.5, -0.3, 0.2}, 1.0 / 30);
  const auto world_from_camera = pose(expected) * options.body_from_camera;
  const cv::Mat view = render(scene(), options.camera, world_from_camera);
  EXPECT_EQ(cv::norm(frame->gray, view, cv::NORM_INF), 0);
  ASSERT_TRUE(frame->attitude);
  EXPECT_EQ(frame->attitude->roll, expected.roll);
  EXPECT_EQ(frame->attitude->pitch, expected.pitch);
  EXPECT_EQ(frame->attitude->yaw, wrap_angle(expected.yaw));
  EXPECT_NE(expected.pitch, 0);
}

// Two periods and a half: the command for frame 0 is obeyed from the middle of the third period on.
TEST(World, ObeysLate) {
  WorldOptions options = small_world(6);
  options.imaging.latency_s = 2.5 / 30;
  World world(scene(), options);
  world.next();
  world.send({0, 0, 1, 0}, 0);
  for (int k = 1; k <= 2; ++k) {
    world.next();
    EXPECT_EQ(world.motion().world_from_body.translation, options.start.position_m) << k;
  }
  world.next();
  // v' = (1 - v) / 0.4 for 1/60 s: z = t - 0.4 (1 - e^(-t / 0.4)), but for Euler's first order.
  const double t = 1.0 / 60;
  const double climbed = t - 0.4 * (1 - std::exp(-t / 0.4));
  EXPECT_NEAR(world.motion().world_from_body.translation.z() - options.start.position_m.z(),
              climbed, 0.15 * climbed);
}

TEST(World, DropsFramesAndFliesOn) {
  WorldOptions options = small_world(400);
  options.imaging.drop_share = 0.25;
  World world(scene(), options);
  int seen = 0;
  std::int64_t last = -1;
  while (const auto frame = world.next()) {
    EXPECT_GT(frame->index, last);
    EXPECT_EQ(frame->stamp_s, double(frame->index) / 30);
    last = frame->index;
    ++seen;
  }
  EXPECT_NEAR(seen, 300, 35);  // four standard deviations of a binomial
  World again(scene(), options);
  while (again.next()) --seen;
  EXPECT_EQ(seen, 0);
}

TEST(World, TargetGoesItsWay) {
  Scene moving = scene();
  moving.planes[0].motion.velocity_m_s = {0, 0.3, 0};
  moving.planes[0].motion.start_s = 0.1;
  World world(moving, small_world(31));
  while (world.next()) {
  }
  EXPECT_NEAR(world.world_from_target().translation.y(), 0.3 * 0.9, 1e-12);
  EXPECT_LT((world.camera_from_target().translation -
             (world.world_from_camera().inverse() * world.world_from_target()).translation)
                .norm(),
            1e-12);
}

TEST(World, FliesTheRigidBodyToo) {
  WorldOptions options = small_world(90);
  options.vehicle = RotorcraftSystem{};
  World world(scene(), options);
  for (int k = 0; k < 90; ++k) {
    const auto frame = world.next();
    EXPECT_NE(frame->attitude->roll, 0);  // it leans against its tail rotor
    world.send({1, 0, 0, 0}, frame->stamp_s);
  }
  EXPECT_GT(world.motion().velocity_m_s.x(), 0.9);
}

TEST(World, TruthIsWhereTheTargetIsSeen) {
  WorldOptions options = small_world(1);
  options.start.position_m << -5, 0, 0;
  const TargetPose ahead = World(scene(), options).camera_from_target();
  EXPECT_LT((ahead.rotation - Eigen::Matrix3d::Identity()).norm(), 1e-15);
  EXPECT_LT((ahead.translation - Vector3d(0, 0, 5)).norm(), 1e-15);
  // 2 m west of the target, 1 m below it, turned 30 deg to the east, camera 0.3 m ahead.
  options.start.position_m << -5, -2, 1;
  options.start.yaw = M_PI / 6;
  options.body_from_camera.translation << 0.3, 0, 0;
  const TargetPose side = World(scene(), options).camera_from_target();
  const double c = std::cos(M_PI / 6);
  const double s = std::sin(M_PI / 6);
  const Vector3d expected(2 * c - 5 * s, -1, 5 * c + 2 * s - 0.3);
  EXPECT_LT((side.translation - expected).norm(), 1e-14);
}

TEST(World, SameSeedSameFilm) {
  WorldOptions options = small_world(5);
  options.imaging.noise_grey = 3;
  World a(scene(), options);
  World b(scene(), options);
  options.seed = 2;
  World c(scene(), options);
  cv::Mat previous;
  for (int k = 0; k < 5; ++k) {
    const cv::Mat film = a.next()->gray;
    EXPECT_EQ(cv::norm(film, b.next()->gray, cv::NORM_INF), 0);
    EXPECT_GT(cv::norm(film, c.next()->gray, cv::NORM_INF), 0);
    if (k > 0) {
      EXPECT_GT(cv::norm(film, previous, cv::NORM_INF), 0);  // nothing moved: the noise
    }
    previous = film;
  }
}

TEST(World, RefusesOptionsOutOfRange) {
  const auto refuses = [](auto spoil) {
    WorldOptions options = small_world(1);
    spoil(options);
    EXPECT_THROW(World(scene(), options), std::invalid_argument);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuses([](WorldOptions& o) { o.rate_hz = 0; });
  refuses([nan](WorldOptions& o) { o.rate_hz = nan; });
  refuses([](WorldOptions& o) { o.frames = -1; });
  refuses([](WorldOptions& o) { o.imaging.noise_grey = -1; });
  refuses([](WorldOptions& o) { o.command_timeout_s = 0; });
  refuses([nan](WorldOptions& o) { o.start.yaw = nan; });
  refuses([](WorldOptions& o) { o.body_from_camera.rotation *= 2; });
  refuses([](WorldOptions& o) {
    HelicopterOptions helicopter;
    helicopter.substeps = 0;
    o.vehicle = helicopter;
  });
  refuses([](WorldOptions& o) { o.imaging.drop_share = 1; });
  refuses([](WorldOptions& o) { o.imaging.latency_s = -1; });
  refuses([](WorldOptions& o) { o.imaging.shutter.exposure_s = 2; });
}

}  // namespace
}  // namespace kestrel

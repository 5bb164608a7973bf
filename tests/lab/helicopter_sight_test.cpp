#include "kestrel/lab/helicopter_sight.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/lab/helicopter_benchmark.hpp"

#include "support/random.hpp"

namespace kestrel {
namespace {

HelicopterSetup setup_of(HelicopterVariant variant, Law law = Law::Des,
                         const std::string& modifier = "") {
  return helicopter_experiment(helicopter_h0(), variant, law, modifier).setup;
}

HelicopterState random_state(test::Random& random) {
  HelicopterState s;
  s.position_m = Eigen::Vector3d(-8, 0, 0) + random.vector3(1);
  s.roll = random.uniform(-0.2, 0.2);
  s.pitch = random.uniform(-0.2, 0.2);
  s.yaw = random.uniform(-0.2, 0.2);
  return s;
}

/// Told at the last of these states, one a frame.
std::optional<HelicopterLawInput> told(const HelicopterSetup& setup,
                                       const std::vector<HelicopterState>& states) {
  HelicopterSight sight(setup);
  std::optional<HelicopterLawInput> input;
  for (std::size_t k = 0; k < states.size(); ++k) {
    sight.look(frame_at(setup, int(k), states[k]));
    input = sight.told();
  }
  return input;
}

TEST(HelicopterSight, APointIsWhereTheTiltedCameraSeesIt) {
  test::Random random("frame");
  const HelicopterSetup setup = setup_of(HelicopterVariant::Vp4);
  const HelicopterState s = random_state(random);
  const HelicopterFrame frame = frame_at(setup, 3, s);
  EXPECT_NEAR(frame.time_s, 0.1, 1e-15);
  const auto& camera = setup.scenario.body_from_camera;
  const Eigen::Vector3d corner(0, 0.5, -0.5);  // point 1, NED
  const Eigen::Vector3d in_body = pose(s).rotation.transpose() * (corner - s.position_m);
  const Eigen::Vector3d p = camera.rotation.transpose() * (in_body - camera.translation);
  EXPECT_NEAR(frame.points[1].at.x, p.x() / p.z(), 1e-14);
  EXPECT_NEAR(frame.points[1].at.y, p.y() / p.z(), 1e-14);
  EXPECT_NEAR(frame.points[1].depth_m, p.z(), 1e-13);
}

TEST(HelicopterSight, TheTargetMovesAlong) {
  HelicopterSetup setup = setup_of(HelicopterVariant::Vp4);
  setup.scenario.target_velocity_m_s = {0.1, 0.3, -0.2};
  HelicopterState s;
  s.position_m = {-8, 0, 0};
  const HelicopterFrame now = frame_at(setup, 0, s);
  s.position_m += setup.scenario.target_velocity_m_s * 2;
  const HelicopterFrame later = frame_at(setup, 60, s);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(now.points[i].at.x, later.points[i].at.x, 1e-14);
    EXPECT_NEAR(now.points[i].depth_m, later.points[i].depth_m, 1e-13);
  }
}

TEST(HelicopterSight, TellsTheImageOfTheLatencyAndTheHeadingOfNow) {
  test::Random random("late");
  const HelicopterSetup setup = setup_of(HelicopterVariant::Vp4, Law::Des, "d2_kz2");
  std::vector<HelicopterState> states;
  for (int k = 0; k < 5; ++k) states.push_back(random_state(random));
  const auto input = told(setup, states);
  ASSERT_TRUE(input);
  const HelicopterFrame used = frame_at(setup, 2, states[2]);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(input->camera.measured[i].at.x, used.points[i].at.x);
    EXPECT_EQ(input->camera.measured[i].depth_m, 2 * used.points[i].depth_m);
    EXPECT_EQ(input->camera.desired[i].depth_m, 10);
  }
  EXPECT_EQ(input->attitude.roll, states[2].roll);
  EXPECT_EQ(input->attitude.pitch, states[2].pitch);
  EXPECT_EQ(input->heading_rad, states[4].yaw);
  EXPECT_FALSE(input->now_from_then);
  states.resize(2);  // frames 0 and 1: there is the first image only
  const auto early = told(setup, states);
  EXPECT_EQ(early->camera.measured[0].at.x, frame_at(setup, 0, states[0]).points[0].at.x);
  EXPECT_FALSE(early->camera.camera_motion);  // the same image again
}

TEST(HelicopterSight, KnownMotionTakesTheOldPointsToTheNew) {
  test::Random random("motion");
  for (const HelicopterVariant variant : {HelicopterVariant::Vp3, HelicopterVariant::Raw4}) {
    const HelicopterSetup setup = setup_of(variant, Law::Des, "d3_pred");
    std::vector<HelicopterState> states;
    for (int k = 0; k < 6; ++k) states.push_back(random_state(random));
    const auto input = told(setup, states);
    const HelicopterFrame then = frame_at(setup, 2, states[2]);
    const HelicopterFrame now = frame_at(setup, 5, states[5]);
    const auto seen = [&](const HelicopterFrame& frame) {
      const bool level = variant == HelicopterVariant::Vp3;
      const auto camera = level ? level_camera(setup, frame) : frame.world_from_camera;
      return seen_points(camera.inverse() * setup.scenario.world_from_target,
                         setup.scenario.points_m);
    };
    const std::vector<Feature> moved = predicted(seen(then), *input->now_from_then);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(moved[i].at.x, seen(now)[i].at.x, 1e-13);
      EXPECT_NEAR(moved[i].at.y, seen(now)[i].at.y, 1e-13);
    }
    // From the image told before to this one: the exponential leads from camera to camera.
    const HelicopterFrame before = frame_at(setup, 1, states[1]);
    const Displacement step = exponential(*input->camera.camera_motion, 1);
    const CameraMotion before_from_then{step.rotation, step.translation};
    const std::vector<Feature> back = predicted(seen(then), before_from_then);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(back[i].at.x, seen(before)[i].at.x, 1e-12);
  }
}

TEST(HelicopterSight, BiasesAreAddedToTheAttitude) {
  test::Random random("bias");
  const HelicopterState s = random_state(random);
  const auto input = told(setup_of(HelicopterVariant::Vp4, Law::Des, "roll1_pitch2_yaw3"), {s});
  constexpr double kDegree = M_PI / 180;
  EXPECT_NEAR(input->attitude.roll, s.roll + kDegree, 1e-15);
  EXPECT_NEAR(input->attitude.pitch, s.pitch + 2 * kDegree, 1e-15);
  EXPECT_NEAR(input->attitude.yaw, s.yaw + 3 * kDegree, 1e-15);
  EXPECT_NEAR(input->heading_rad, s.yaw + 3 * kDegree, 1e-15);
}

TEST(HelicopterSight, NoiseHasItsDeviationInPixels) {
  HelicopterSetup setup = setup_of(HelicopterVariant::Vp4, Law::Des, "n2");
  HelicopterSight sight(setup);
  HelicopterState s;
  s.position_m = {-8, 0, 0};
  double squares = 0;
  const int frames = 500;
  for (int k = 0; k < frames; ++k) {
    const HelicopterFrame frame = frame_at(setup, k, s);
    sight.look(frame);
    const auto input = sight.told();
    for (std::size_t i = 0; i < 4; ++i) {
      squares += std::pow(600 * (input->camera.measured[i].at.x - frame.points[i].at.x), 2);
      squares += std::pow(600 * (input->camera.measured[i].at.y - frame.points[i].at.y), 2);
    }
  }
  EXPECT_NEAR(std::sqrt(squares / (8 * frames)), 2, 0.1);  // 4000 draws: +-0.022, 1 sigma
}

TEST(HelicopterSight, ALostTargetIsNotTold) {
  HelicopterSetup setup = setup_of(HelicopterVariant::Vp4);
  setup.conditions.loss = TargetLoss{0.1, 0.1};  // frames 3, 4, 5
  HelicopterSight sight(setup);
  HelicopterState s;
  s.position_m = {-8, 0, 0};
  std::string seen;
  for (int k = 0; k < 8; ++k) {
    sight.look(frame_at(setup, k, s));
    const auto input = sight.told();
    seen += input ? (input->camera.camera_motion ? 'm' : 's') : '-';
  }
  EXPECT_EQ(seen, "smm---sm");  // after a gap nothing is known of the motion
}

TEST(HelicopterSight, PoseLawsGetThePoseOfTheirPoints) {
  test::Random random("pose");
  const HelicopterState s = random_state(random);
  const HelicopterSetup setup = setup_of(HelicopterVariant::Vp4, Law::PbvsCt, "kz2");
  const auto input = told(setup, {s});
  ASSERT_TRUE(input->camera.camera_from_target);
  const TargetPose truth = frame_at(setup, 0, s).camera_from_target;
  const TargetPose& pose = *input->camera.camera_from_target;
  EXPECT_LT((pose.rotation - truth.rotation).norm(), 1e-9);
  EXPECT_LT((pose.translation - 2 * truth.translation).norm(), 1e-8);
  EXPECT_FALSE(told(setup_of(HelicopterVariant::Vp4), {s})->camera.camera_from_target);
}

}  // namespace
}  // namespace kestrel

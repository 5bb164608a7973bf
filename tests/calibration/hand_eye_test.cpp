#include "kestrel/calibration/hand_eye.hpp"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/geometry/mount_preset.hpp"
#include "kestrel/io/mount_file.hpp"

#include "calibration/hand_eye_scene.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

constexpr double kDegree = M_PI / 180;

test::HandEyeScene scene_of(MountPreset preset) {
  test::HandEyeScene scene;
  scene.body_from_camera = {mount_rotation(preset), {0.3, -0.05, 0.1}};
  return scene;
}

/// What a good attitude sensor and a target of 200 px are off by.
const test::HandEyeNoise kUsual{0.3 * kDegree, 0.4 * kDegree, 0.005, 0.005};

double angle(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return rotation_vector(a.transpose() * b).norm();
}

TEST(HandEye, FindsTheMountFromPerfectStations) {
  for (const MountPreset preset : all_mount_presets()) {
    test::Random random(std::string("hand eye ") + name(preset));
    const test::HandEyeScene scene = scene_of(preset);
    const HandEyeResult result = hand_eye(test::stations_of(scene, random));
    ASSERT_TRUE(result.body_from_camera.has_value()) << hand_eye_text(result);
    EXPECT_FALSE(is_refused(result.objections)) << hand_eye_text(result);
    // ViSP iterates until its error changes by less than 1e-6 or so.
    EXPECT_LT(angle(result.body_from_camera->rotation, scene.body_from_camera.rotation), 1e-5);
    EXPECT_LT((result.body_from_camera->translation - scene.body_from_camera.translation).norm(),
              1e-4);
    EXPECT_LT(result.residual_rad, 1e-5);
    EXPECT_LT(*result.residual_m, 1e-4);
  }
}

TEST(HandEye, FindsTheRotationWhereNobodyKnowsThePlace) {
  test::Random random("hand eye no place");
  test::HandEyeScene scene = scene_of(MountPreset::Forward45Down);
  scene.positions = test::HandEyeScene::Positions::Unknown;
  const HandEyeResult result = hand_eye(test::stations_of(scene, random));
  ASSERT_TRUE(result.body_from_camera.has_value()) << hand_eye_text(result);
  EXPECT_LT(angle(result.body_from_camera->rotation, scene.body_from_camera.rotation), 1e-5);
  EXPECT_FALSE(result.translation_deviation_m.has_value());
  EXPECT_FALSE(result.residual_m.has_value());
  EXPECT_EQ(result.body_from_camera->translation, Eigen::Vector3d(0, 0, 0));
}

TEST(HandEye, ItsResidualIsTheNoise) {
  test::Random random("hand eye residual");
  test::HandEyeScene scene = scene_of(MountPreset::Forward);
  scene.stations = 40;
  scene.noise.pose_rad = 0.01;
  const HandEyeResult result = hand_eye(test::stations_of(scene, random));
  // Three components of 0.01 rad each; 40 stations give it to about 7 %.
  EXPECT_NEAR(result.residual_rad, 0.01 * std::sqrt(3.0), 0.004);
}

TEST(HandEye, RefusesTooFewStationsAndOneAxis) {
  test::Random random("hand eye refusals");
  test::HandEyeScene few = scene_of(MountPreset::Forward);
  few.stations = 5;
  const HandEyeResult none = hand_eye(test::stations_of(few, random));
  EXPECT_FALSE(none.body_from_camera.has_value());
  EXPECT_THAT(hand_eye_text(none), HasSubstr("REFUSED: there are 5 different attitudes, 6 are"));
  test::HandEyeScene yaw = scene_of(MountPreset::Forward);
  yaw.largest_turn_rad = {0.001, 0.001, 0.8};
  const HandEyeResult one = hand_eye(test::stations_of(yaw, random));
  EXPECT_FALSE(one.body_from_camera.has_value());
  EXPECT_THAT(hand_eye_text(one), HasSubstr("about one axis only"));
  EXPECT_THAT(hand_eye_text(one), HasSubstr("do: turn it about two axes at least"));
  EXPECT_FALSE(hand_eye({}).body_from_camera.has_value());
}

TEST(HandEye, RefusesPicturesOfOtherMoments) {
  test::Random random("hand eye moments");
  auto stations = test::stations_of(scene_of(MountPreset::Forward), random);
  auto two_swapped = stations;
  std::swap(two_swapped[3].camera_from_target, two_swapped[4].camera_from_target);
  const HandEyeResult swapped = hand_eye(two_swapped);
  EXPECT_TRUE(is_refused(swapped.objections));
  EXPECT_THAT(hand_eye_text(swapped), HasSubstr("REFUSED: the target seems to turn by"));
  for (std::size_t i = 0; i + 1 < stations.size(); ++i)
    stations[i].camera_from_target = stations[i + 1].camera_from_target;
  const HandEyeResult late = hand_eye(stations);
  EXPECT_TRUE(is_refused(late.objections)) << hand_eye_text(late);
  EXPECT_THAT(hand_eye_text(late), HasSubstr("same moment"));
}

TEST(HandEye, DoubtsWhatIsHardlyKnown) {
  test::Random random("hand eye doubts");
  test::HandEyeScene scene = scene_of(MountPreset::Forward);
  scene.stations = 8;
  scene.noise = {2 * kDegree, 2 * kDegree, 0.1, 0.3};
  const HandEyeResult result = hand_eye(test::stations_of(scene, random));
  ASSERT_TRUE(result.body_from_camera.has_value());
  EXPECT_FALSE(is_refused(result.objections)) << hand_eye_text(result);
  EXPECT_THAT(hand_eye_text(result), HasSubstr("8 different attitudes only"));
  EXPECT_THAT(hand_eye_text(result), HasSubstr("degrees only"));
  EXPECT_THAT(hand_eye_text(result), HasSubstr("m only"));
}

TEST(HandEye, WritesAMountFile) {
  test::Random random("hand eye file");
  test::HandEyeScene scene = scene_of(MountPreset::Down);
  scene.noise = kUsual;
  const HandEyeResult result = hand_eye(test::stations_of(scene, random));
  const test::TempFolder folder;
  const std::string text = hand_eye_mount(result, {9, 9, 9});
  const Mount back = load_mount(folder.write("mount.yaml", text));
  EXPECT_EQ(back.rotation, result.body_from_camera->rotation);
  EXPECT_EQ(back.translation, result.body_from_camera->translation)
      << "measured: not what is given";
  scene.positions = test::HandEyeScene::Positions::Unknown;
  const HandEyeResult turned = hand_eye(test::stations_of(scene, random));
  EXPECT_EQ(load_mount(folder.write("m.yaml", hand_eye_mount(turned, {1, 2, 3}))).translation,
            Eigen::Vector3d(1, 2, 3));
}

TEST(HandEye, OptionsNameWhatIsOutOfRange) {
  HandEyeOptions options;
  options.smallest_spread_rad = 0;
  EXPECT_THAT(test::message_of([&] { options.check(); }), HasSubstr("smallest_spread_rad"));
  options = {};
  options.fewest_stations = 3;
  EXPECT_THAT(test::message_of([&] { hand_eye({}, options); }), HasSubstr("fewest_stations"));
}

}  // namespace
}  // namespace kestrel

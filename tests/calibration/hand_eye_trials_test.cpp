// The deviations that hand_eye states, against a known truth.
#include <cstdio>

#include <gtest/gtest.h>

#include "kestrel/calibration/hand_eye.hpp"
#include "kestrel/geometry/mount_preset.hpp"

#include "calibration/hand_eye_scene.hpp"

namespace kestrel {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr int kTrials = 100;

/// In how many trials each of x, y, z (rotation), forward, right, down is within three deviations.
std::array<int, 6> trials(const test::HandEyeScene& scene, const std::string& name) {
  std::array<int, 6> within{};
  double worst_rad = 0;
  for (int i = 0; i < kTrials; ++i) {
    test::Random random(name + std::to_string(i));
    const HandEyeResult r = hand_eye(test::stations_of(scene, random));
    if (!r.body_from_camera) continue;
    const Eigen::Vector3d turn =
        rotation_vector(scene.body_from_camera.rotation.transpose() * r.body_from_camera->rotation);
    const Eigen::Vector3d shift =
        r.body_from_camera->translation - scene.body_from_camera.translation;
    worst_rad = std::max(worst_rad, turn.norm());
    for (int k = 0; k < 3; ++k) {
      if (std::abs(turn[k]) <= 3 * r.rotation_deviation_rad[k]) ++within[std::size_t(k)];
      if (r.translation_deviation_m && std::abs(shift[k]) <= 3 * (*r.translation_deviation_m)[k])
        ++within[std::size_t(k) + 3];
    }
  }
  std::printf("%s: within 3 deviations: %d %d %d, %d %d %d of %d; worst %.2f deg\n", name.c_str(),
              within[0], within[1], within[2], within[3], within[4], within[5], kTrials,
              worst_rad / kDegree);
  return within;
}

TEST(HandEyeTrials, TheTruthIsWithinThreeDeviations) {
  test::HandEyeScene scene;
  scene.body_from_camera = {mount_rotation(MountPreset::Forward45Down), {0.3, -0.05, 0.1}};
  scene.stations = 15;
  scene.noise = {0.3 * kDegree, 0.4 * kDegree, 0.005, 0.005};
  const auto known = trials(scene, "positions known");
  for (const int count : known) EXPECT_GE(count, 95);
  scene.positions = test::HandEyeScene::Positions::Unknown;
  const auto unknown = trials(scene, "positions unknown");
  for (std::size_t i = 0; i < 3; ++i) EXPECT_GE(unknown[i], 95);
}

}  // namespace
}  // namespace kestrel

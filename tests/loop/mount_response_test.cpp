#include "kestrel/loop/mount_response.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "kestrel/geometry/mount_preset.hpp"
#include "kestrel/geometry/rotation.hpp"

#include "loop/flight.hpp"

namespace kestrel {
namespace {

constexpr double kDegree = M_PI / 180;

Task task_of(MountPreset preset) {
  return task_with_mount({mount_rotation(preset), {0.3, 0, 0.1}});
}

std::vector<std::string> words_of(const Task& task) {
  std::vector<std::string> all;
  for (const MountResponse& response : mount_responses(task)) all.push_back(describe(response));
  return all;
}

const std::string kRight = "target to the right in the image -> the vehicle ";
const std::string kLower = "target lower in the image -> the vehicle ";
const std::string kLarger = "target larger in the image -> the vehicle ";
const std::string kClockwise = "target turned clockwise in the image -> the vehicle ";
const std::string kStays = "stays: no velocity that the law may use undoes it";

TEST(MountResponse, OfANoseCamera) {
  EXPECT_EQ(words_of(task_of(MountPreset::Forward)),
            (std::vector<std::string>{kRight + "moves right", kLower + "moves down",
                                      kLarger + "moves backward", kClockwise + kStays}));
}

TEST(MountResponse, OfABellyCamera) {
  // A target turned clockwise as seen from above asks for a turn of the nose to the right.
  EXPECT_EQ(words_of(task_of(MountPreset::Down)),
            (std::vector<std::string>{kRight + "moves right", kLower + "moves backward",
                                      kLarger + "moves up", kClockwise + "turns its nose right"}));
}

TEST(MountResponse, OfACameraInTheLeftSide) {
  EXPECT_EQ(words_of(task_of(MountPreset::Left)),
            (std::vector<std::string>{kRight + "moves forward", kLower + "moves down",
                                      kLarger + "moves right", kClockwise + kStays}));
}

TEST(MountResponse, OfACameraPitchedDown) {
  const auto words = words_of(task_of(MountPreset::Forward45Down));
  EXPECT_EQ(words[0], kRight + "moves right");
  EXPECT_EQ(words[1].rfind(kLower + "moves ", 0), 0u);
  EXPECT_NE(words[1].find("down"), std::string::npos) << words[1];
  EXPECT_NE(words[1].find("backward"), std::string::npos) << words[1];
  EXPECT_NE(words[2].find("up"), std::string::npos) << words[2];
  EXPECT_NE(words[2].find("backward"), std::string::npos) << words[2];
}

TEST(MountResponse, OfAMirroredMountIsRefused) {
  Task task = task_of(MountPreset::Forward);
  task.body_from_camera.rotation.col(0) *= -1;
  const auto all = mount_responses(task);
  EXPECT_EQ(all[0].refusal, LawRefusal::Unreachable);
  EXPECT_EQ(describe(all[0]),
            "target to the right in the image -> no command: the law has no answer (unreachable)");
}

TEST(MountResponse, SaysTheOppositeOfACameraUpsideDown) {
  Task task = task_of(MountPreset::Forward);
  task.body_from_camera.rotation =
      task.body_from_camera.rotation * rotation_from_rpy(0, 0, 180 * kDegree);
  EXPECT_EQ(words_of(task)[0], kRight + "moves left");
  EXPECT_EQ(words_of(task)[1], kLower + "moves up");
}

TEST(MountResponse, IsThatOfEveryLawThatAnswers) {
  // All laws aim at the same goal; near it they agree on the direction.
  for (const Law law : {Law::Cur, Law::Des, Law::Mean, Law::PbvsCt, Law::Homog, Law::TwoAndHalfD}) {
    Task task = task_of(MountPreset::Down);
    task.servo.law = law;
    EXPECT_EQ(words_of(task)[0], kRight + "moves right") << name(law);
    EXPECT_EQ(words_of(task)[3], kClockwise + "turns its nose right") << name(law);
  }
}

TEST(MountResponse, IsNotHiddenByASmoothStart) {
  Task task = task_of(MountPreset::Forward);
  task.servo.smooth_start_per_s = 4;
  EXPECT_EQ(words_of(task)[0], kRight + "moves right");
}

/// The command, flown by composing poses, brings the target back: this is what the words promise.
TEST(MountResponse, UndoesTheChangeWhenItIsFlown) {
  for (const MountPreset preset : all_mount_presets()) {
    const Task task = task_of(preset);
    for (const MountResponse& r : mount_responses(task)) {
      if (r.effort < 0.1) continue;
      const test::Flight before;
      const test::Flight after = before.after(r.command, 1 / task.servo.gain_per_s);
      // A hundredth of the distance, or of a radian, was to be undone.
      const double step = 0.01;
      TargetPose seen = task.goal;
      if (r.change == ImageChange::Right) seen.translation.x() += step * 5;
      if (r.change == ImageChange::Lower) seen.translation.y() += step * 5;
      if (r.change == ImageChange::Larger) seen.translation.z() -= step * 5;
      if (r.change == ImageChange::Clockwise) seen.rotation = rotation_from_vector({0, 0, step});
      const Mount& mount = task.body_from_camera;
      const auto world_from_target = before.camera(mount) * seen;
      const TargetPose now = after.camera(mount).inverse() * world_from_target;
      const auto off = [&](const TargetPose& pose) {
        double sum = 0;
        const std::vector<Feature> at = features(pose, target_corners(task));
        const std::vector<Feature> wanted = desired_features(task);
        for (std::size_t i = 0; i < at.size(); ++i)
          sum += std::hypot(at[i].at.x - wanted[i].at.x, at[i].at.y - wanted[i].at.y);
        return sum;
      };
      // A turn about a slanting view is one of roll and yaw, and only the yaw may be used.
      const bool is_half =
          preset == MountPreset::Forward45Down && r.change == ImageChange::Clockwise;
      EXPECT_LT(off(now), (is_half ? 0.9 : 0.1) * off(seen)) << name(preset) << ": " << describe(r);
    }
  }
}

}  // namespace
}  // namespace kestrel

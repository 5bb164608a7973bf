#include "kestrel/geometry/mount_preset.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = M_PI / 180;

TEST(MountPreset, IsARotationToRounding) {
  for (const MountPreset preset : all_mount_presets())
    EXPECT_LT(rotation_defect(mount_rotation(preset)), 1e-15) << name(preset);
}

TEST(MountPreset, HasTheAnglesThatTheMountFilesWrite) {
  const auto rotation = [](double roll_deg, double yaw_deg) {
    return rotation_from_rpy(roll_deg * kDegree, 0, yaw_deg * kDegree);
  };
  // cos(90 deg) is 6e-17 in doubles.
  const auto expect = [&](MountPreset preset, double roll_deg, double yaw_deg) {
    EXPECT_TRUE(mount_rotation(preset).isApprox(rotation(roll_deg, yaw_deg), 1e-15))
        << name(preset);
  };
  expect(MountPreset::Forward, 90, 90);
  expect(MountPreset::Down, 0, 90);
  expect(MountPreset::Left, 90, 0);
  expect(MountPreset::Forward45Down, 45, 90);
}

TEST(MountPreset, LooksWhereItsNameSays) {
  const Vector3d forward = Vector3d::UnitX();
  const Vector3d right = Vector3d::UnitY();
  const Vector3d down = Vector3d::UnitZ();
  const auto look = [](MountPreset preset) { return Vector3d(mount_rotation(preset).col(2)); };
  EXPECT_EQ(look(MountPreset::Forward), forward);
  EXPECT_EQ(look(MountPreset::Down), down);
  EXPECT_EQ(look(MountPreset::Left), -right);
  EXPECT_NEAR(look(MountPreset::Forward45Down).dot(forward), std::cos(45 * kDegree), 1e-15);
  EXPECT_NEAR(look(MountPreset::Forward45Down).dot(down), std::sin(45 * kDegree), 1e-15);
}

TEST(MountPreset, IsFoundByItsName) {
  for (const MountPreset preset : all_mount_presets())
    EXPECT_EQ(mount_preset_named(name(preset)), preset);
  EXPECT_FALSE(mount_preset_named("sideways").has_value());
}

}  // namespace
}  // namespace kestrel

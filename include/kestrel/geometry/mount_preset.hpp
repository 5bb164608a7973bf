#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace kestrel {

/// Ways in which a camera is usually screwed on, upright: no wing or skid is seen as up.
enum class MountPreset {
  Forward,        // "forward": out of the nose; image right is right, image down is down
  Down,           // "down": out of the belly; image right is right, the image's top is the nose
  Left,           // "left": out of the left side; image right is forward, image down is down
  Forward45Down,  // "forward_45_down": forward, pitched down by 45 degrees; image right is right
};

/// All of them, in the order of the enumeration.
const std::vector<MountPreset>& all_mount_presets();

/// The word in quotes above.
const char* name(MountPreset preset);

/// The preset of that name; empty when there is none.
std::optional<MountPreset> mount_preset_named(std::string_view name);

/// Rotation body_from_camera: its columns are the camera's axes (x image right, y image down, z
/// into the scene) seen in the helicopter (x forward, y right, z down).
Eigen::Matrix3d mount_rotation(MountPreset preset);

}  // namespace kestrel

#include "kestrel/geometry/mount_preset.hpp"

#include <cmath>
#include <stdexcept>

namespace kestrel {

const std::vector<MountPreset>& all_mount_presets() {
  static const std::vector<MountPreset> all = {MountPreset::Forward, MountPreset::Down,
                                               MountPreset::Left, MountPreset::Forward45Down};
  return all;
}

const char* name(MountPreset preset) {
  switch (preset) {
    case MountPreset::Forward:
      return "forward";
    case MountPreset::Down:
      return "down";
    case MountPreset::Left:
      return "left";
    case MountPreset::Forward45Down:
      return "forward_45_down";
  }
  return "unknown";
}

std::optional<MountPreset> mount_preset_named(std::string_view name) {
  for (const MountPreset preset : all_mount_presets())
    if (name == kestrel::name(preset)) return preset;
  return std::nullopt;
}

Eigen::Matrix3d mount_rotation(MountPreset preset) {
  const Eigen::Vector3d forward = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d down = Eigen::Vector3d::UnitZ();
  const double s = std::sqrt(0.5);
  Eigen::Matrix3d R;
  switch (preset) {
    case MountPreset::Forward:
      R << right, down, forward;
      return R;
    case MountPreset::Down:
      R << right, -forward, down;
      return R;
    case MountPreset::Left:
      R << forward, down, -right;
      return R;
    case MountPreset::Forward45Down:
      R << right, s * (down - forward), s * (forward + down);
      return R;
  }
  throw std::logic_error("a mount preset without a rotation");
}

}  // namespace kestrel

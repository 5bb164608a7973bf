#include "kestrel/io/mount_file.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "kestrel/geometry/mount_preset.hpp"

#include "pose_section.hpp"

namespace kestrel {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kLargestLever_m = 20;

/// One of the ready-made directions, at the reference point unless translation_m says where.
Mount mount_of_preset(const Section& section) {
  refuse_ambiguous(section);
  only_one_of(section, {"preset", "rotation", "theta_u_deg", "rpy_deg", "data"});
  std::vector<std::pair<std::string, MountPreset>> words;
  for (const MountPreset preset : all_mount_presets()) words.emplace_back(name(preset), preset);
  const Eigen::Matrix3d R = mount_rotation(section.choice("preset", words));
  if (!section.has("translation_m")) return {R, Eigen::Vector3d::Zero()};
  const std::vector<double> t = section.numbers("translation_m", 3);
  return {R, {t[0], t[1], t[2]}};
}

/// A direction in Body in words: the nearest axis and, beyond half a degree, by how much it leans
/// and where to.
std::string direction(const Eigen::Vector3d& d, const std::array<const char*, 6>& names) {
  const auto name = [&](int axis) { return names[2 * std::size_t(axis) + (d[axis] < 0 ? 1 : 0)]; };
  int nearest = 0;
  d.cwiseAbs().maxCoeff(&nearest);
  const double lean_deg = std::acos(std::fmin(1, std::abs(d[nearest]))) / kDegree;
  if (lean_deg < 0.5) return name(nearest);
  Eigen::Vector3d rest = d.cwiseAbs();
  rest[nearest] = 0;
  int second = 0;
  rest.maxCoeff(&second);
  return fmt::format("{}, {:.0f} deg towards {}", name(nearest), lean_deg, name(second));
}

std::string place(const Eigen::Vector3d& t) {
  static const std::array<std::array<const char*, 2>, 3> words = {
      {{"ahead of", "behind"}, {"right of", "left of"}, {"below", "above"}}};
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(t[axis]) < 0.005) continue;
    text += fmt::format("{}{:.2f} m {}", text.empty() ? "" : ", ", std::abs(t[axis]),
                        words[std::size_t(axis)][t[axis] < 0 ? 1 : 0]);
  }
  return text.empty() ? "at the reference point" : text + " the reference point";
}

}  // namespace

Mount read_mount(const Section& section) {
  if (section.has("file")) return load_mount(section.path("file"));
  Mount mount = section.has("preset") ? mount_of_preset(section)
                                      : read_pose<frame::Body, frame::Camera>(section);
  const double lever = mount.translation.norm();
  if (lever > kLargestLever_m) {
    section.fail(
        section.has("data") ? "data" : "translation_m",
        fmt::format("puts the camera {:.4g} m from the reference point; give metres", lever));
  }
  return mount;
}

Mount load_mount(const std::filesystem::path& file) {
  const Section root = Section::load(file);
  Mount mount = read_mount(root);
  root.done();
  return mount;
}

std::string describe(const Mount& body_from_camera) {
  const Eigen::Matrix3d& R = body_from_camera.rotation;
  return "the camera looks " +
         direction(R.col(2), {"forward", "backward", "right", "left", "down", "up"}) +
         "; image right is the helicopter's " +
         direction(R.col(0), {"front", "rear", "right", "left", "underside", "top"}) + "; " +
         place(body_from_camera.translation);
}

}  // namespace kestrel

#include "kestrel/io/mount_file.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/geometry/twist.hpp"

namespace kestrel {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kLargestDefect = 1e-3;  // of numbers written with three decimals
constexpr double kRounding = 1e-14;      // of a rotation in full precision
constexpr double kLargestLever_m = 20;

Eigen::Matrix3d rotation_from_matrix(const Section& section) {
  const std::vector<double> n = section.numbers("rotation", 9);
  Eigen::Matrix3d M;
  M << n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8];
  const double columns = (M.transpose() * M - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (columns > kLargestDefect) {
    section.fail("rotation",
                 fmt::format("is no rotation: R^T R is off the identity by {:.3g}; give "
                             "orthogonal columns of length 1, or rpy_deg",
                             columns));
  }
  if (M.determinant() < 0) {
    section.fail("rotation",
                 "is a mirror image (determinant -1), no rotation; negate or swap one column, or "
                 "give rpy_deg");
  }
  return columns > kRounding ? nearest_rotation(M) : M;  // what is one stays as it is, to the bit
}

Eigen::Matrix3d rotation_from_angles(const Section& section) {
  const std::vector<double> rpy = section.numbers("rpy_deg", 3);
  for (const double angle : rpy) {
    if (std::abs(angle) > 360) {
      section.fail("rpy_deg", fmt::format("{} is beyond 360 degrees; give degrees", angle));
    }
  }
  return rotation_from_rpy(rpy[0] * kDegree, rpy[1] * kDegree, rpy[2] * kDegree);
}

Eigen::Matrix3d rotation_from_axis(const Section& section) {
  const std::vector<double> theta_u = section.numbers("theta_u_deg", 3);
  return rotation_from_vector(Eigen::Vector3d(theta_u[0], theta_u[1], theta_u[2]) * kDegree);
}

/// ViSP's vpPoseVector: translation and theta*u.
Displacement visp_pose(const Section& section) {
  if (section.integer("rows") != 6 || section.integer("cols", 1) != 1) {
    section.fail("rows", "is no pose of ViSP; give 6 rows and 1 column");
  }
  const std::vector<double> n = section.numbers("data", 6);
  return {rotation_from_vector({n[3], n[4], n[5]}), {n[0], n[1], n[2]}};
}

Displacement displacement(const Section& section) {
  if (section.has("data")) return visp_pose(section);
  const std::vector<double> t = section.numbers("translation_m", 3);
  std::vector<std::string> given;
  for (const char* form : {"rotation", "theta_u_deg", "rpy_deg"}) {
    if (section.has(form)) given.emplace_back(form);
  }
  if (given.size() > 1) {
    section.fail(given[0], "is given together with " + given[1] + "; remove one of the two");
  }
  const std::string form = given.empty() ? "rpy_deg" : given[0];
  const Eigen::Matrix3d R = form == "rotation"      ? rotation_from_matrix(section)
                            : form == "theta_u_deg" ? rotation_from_axis(section)
                                                    : rotation_from_angles(section);
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

template <class To, class From>
Transform<To, From> read_pose(const Section& section) {
  const Displacement pose = displacement(section);
  return {pose.rotation, pose.translation};
}

template Mount read_pose(const Section&);
template TargetPose read_pose(const Section&);

Mount read_mount(const Section& section) {
  if (section.has("file")) return load_mount(section.path("file"));
  auto mount = read_pose<frame::Body, frame::Camera>(section);
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

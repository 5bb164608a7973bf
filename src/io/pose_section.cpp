#include "pose_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/geometry/twist.hpp"
#include "kestrel/io/mount_file.hpp"

namespace kestrel {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kQuarter_rad = M_PI / 2;
constexpr double kLargestDefect = 1e-3;  // of numbers written with three decimals
constexpr double kRounding = 1e-14;      // of a rotation in full precision

/// A way to write a rotation that is not read, and why it could be taken for something else.
struct Ambiguous {
  const char* key;
  const char* why;
};

constexpr const char* kOrder = "angles about three axes mean nothing without their order";
constexpr const char* kRadians = "radians are not read";
constexpr const char* kQuaternion = "quaternions are written both w first and w last";

constexpr std::array<Ambiguous, 16> kAmbiguous = {{{"euler", kOrder},
                                                   {"euler_deg", kOrder},
                                                   {"euler_rad", kOrder},
                                                   {"angles_deg", kOrder},
                                                   {"angles_rad", kOrder},
                                                   {"ypr_deg", kOrder},
                                                   {"ypr_rad", kOrder},
                                                   {"rpy", "the unit of the angles is not said"},
                                                   {"theta_u", "the unit of the angle is not said"},
                                                   {"rpy_rad", kRadians},
                                                   {"theta_u_rad", kRadians},
                                                   {"quaternion", kQuaternion},
                                                   {"quaternion_xyzw", kQuaternion},
                                                   {"quaternion_wxyz", kQuaternion},
                                                   {"translation_mm", "metres are read only"},
                                                   {"camera_from_body", "is the inverse"}}};

/// True when each angle is a multiple of half pi, as somebody writes it who thinks in radians.
bool looks_like_radians(const std::vector<double>& angles) {
  bool any = false;
  for (const double angle : angles) {
    const double quarters = std::round(angle / kQuarter_rad);
    if (std::abs(angle - quarters * kQuarter_rad) > 2e-3) return false;
    any = any || quarters != 0;
  }
  return any;
}

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
  if (looks_like_radians(rpy)) {
    section.fail("rpy_deg", "looks like radians (multiples of pi/2); give degrees, 90 for pi/2");
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
  refuse_ambiguous(section);
  const std::string form = only_one_of(section, {"data", "rotation", "theta_u_deg", "rpy_deg"});
  if (form == "data") {
    only_one_of(section, {"data", "translation_m"});
    return visp_pose(section);
  }
  const std::vector<double> t = section.numbers("translation_m", 3);
  const Eigen::Matrix3d R = form == "rotation"      ? rotation_from_matrix(section)
                            : form == "theta_u_deg" ? rotation_from_axis(section)
                                                    : rotation_from_angles(section);
  return {R, {t[0], t[1], t[2]}};
}

}  // namespace

void refuse_ambiguous(const Section& section) {
  const std::vector<std::string> keys = section.keys();  // has() would offer them as known
  for (const Ambiguous& a : kAmbiguous) {
    if (std::find(keys.begin(), keys.end(), a.key) == keys.end()) continue;
    section.fail(a.key, fmt::format("is ambiguous: {}; give translation_m (metres) with rpy_deg "
                                    "[roll, pitch, yaw] (R = Rz(yaw) Ry(pitch) Rx(roll), degrees), "
                                    "or rotation, the matrix whose columns are the camera's axes "
                                    "in the helicopter",
                                    a.why));
  }
}

std::string only_one_of(const Section& section, const std::vector<const char*>& keys) {
  std::string first;
  for (const char* key : keys) {
    if (!section.has(key)) continue;
    if (!first.empty())
      section.fail(first, std::string("is given together with ") + key + "; remove one of the two");
    first = key;
  }
  return first;
}

template <class To, class From>
Transform<To, From> read_pose(const Section& section) {
  const Displacement pose = displacement(section);
  return {pose.rotation, pose.translation};
}

template Mount read_pose(const Section&);
template TargetPose read_pose(const Section&);

}  // namespace kestrel

#pragma once

#include <Eigen/Core>

#include "kestrel/geometry/frames.hpp"
#include "kestrel/geometry/rotation.hpp"

namespace kestrel {

/// Rigid transform that takes the coordinates of a point in From to its coordinates in To:
/// p_in_to = rotation * p_in_from + translation. Read as a pose it is that of From in To
/// (ViSP's toMfrom); named to_from_from, e.g. camera_from_target.
template <class To, class From>
struct Transform {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  /// Origin of From in To, m.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Transform<From, To> inverse() const {
    const Eigen::Matrix3d R_transposed = rotation.transpose();
    return {R_transposed, -(R_transposed * translation)};
  }
};

/// Composition; only adjacent frames compile.
template <class A, class B, class C>
Transform<A, C> operator*(const Transform<A, B>& a_from_b, const Transform<B, C>& b_from_c) {
  return {a_from_b.rotation * b_from_c.rotation,
          a_from_b.rotation * b_from_c.translation + a_from_b.translation};
}

/// Point p_in_from (m) expressed in To.
template <class To, class From>
Eigen::Vector3d operator*(const Transform<To, From>& to_from_from,
                          const Eigen::Vector3d& p_in_from) {
  return to_from_from.rotation * p_in_from + to_from_from.translation;
}

/// Pose of the target plane in the camera (ViSP: cMo).
using TargetPose = Transform<frame::Camera, frame::Target>;
/// How the camera is mounted: its pose in the helicopter (ViSP: bMc or eMc).
using Mount = Transform<frame::Body, frame::Camera>;

}  // namespace kestrel

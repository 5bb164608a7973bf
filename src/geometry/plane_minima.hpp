#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "kestrel/geometry/transform.hpp"

/// Minima of the reprojection error of a rectangle's four corners over its pose.
namespace kestrel::minima {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Residual = Eigen::Matrix<double, 8, 1>;
using Jacobian = Eigen::Matrix<double, 8, 6>;

/// What one view says: corners of the plane (m), where they are on the normalised plane, and how
/// many pixels a step there makes. The step is taken at the measured corner, so the error of a
/// pose is in pixels to first order whatever the lens, and is never thrown off by a lens model's
/// far end.
struct View {
  std::array<Vector3d, 4> corners;
  std::array<Vector2d, 4> seen;
  std::array<Matrix2d, 4> px_per_unit;
};

inline double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The plane's centre on the normalised plane, and how the image moves (1/m) with a point of the
/// plane around it: all that the two solutions have in common.
struct FirstOrder {
  Vector2d centre;
  Matrix2d slope;
};

/// From the homography unit square -> quadrilateral (Heckbert 1989, p. 20).
inline FirstOrder first_order(const View& view) {
  const auto& q = view.seen;
  const Vector2d sum = q[0] - q[1] + q[2] - q[3];
  const Vector2d right = q[1] - q[2];
  const Vector2d bottom = q[3] - q[2];
  const double g = cross(sum, bottom) / cross(right, bottom);
  const double h = cross(right, sum) / cross(right, bottom);
  const Vector2d a = q[1] - q[0] + g * q[1];
  const Vector2d b = q[3] - q[0] + h * q[3];
  const double w = 1 + (g + h) / 2;
  FirstOrder f;
  f.centre = (q[0] + (a + b) / 2) / w;
  f.slope.col(0) = (a - g * f.centre) / (w * (view.corners[1] - view.corners[0]).norm());
  f.slope.col(1) = (b - h * f.centre) / (w * (view.corners[3] - view.corners[0]).norm());
  return f;
}

/// The least turn that takes the optical axis to a line of sight in front of the camera: half its
/// angle as a quaternion. (Eigen's FromTwoVectors also knows opposite vectors, by a decomposition
/// that is never run here and takes longer to compile than all of this file.)
inline Matrix3d turn_from_axis(const Vector3d& sight) {
  const Vector3d to = sight.normalized();
  const double twice_cosine = std::sqrt((1 + to.z()) * 2);  // of half the angle
  const double inverse = 1 / twice_cosine;
  return Eigen::Quaterniond(twice_cosine / 2, -to.y() * inverse, to.x() * inverse, 0).matrix();
}

/// The two poses that agree with the view to first order at the plane's centre: infinitesimal
/// plane-based pose estimation (Collins & Bartoli 2014, section 4). Seen along the line of sight
/// they are the plane tilted to one side and to the other.
inline std::array<TargetPose, 2> starts(const FirstOrder& f) {
  const Vector3d sight(f.centre.x(), f.centre.y(), 1);
  const Matrix3d R_v = turn_from_axis(sight);
  const Matrix2d B = R_v.topLeftCorner<2, 2>() - f.centre * R_v.block<1, 2>(2, 0);
  const Matrix2d A = B.inverse() * f.slope;  // the rotation's upper left, over the depth
  const Matrix2d S = A.transpose() * A;
  const double half_gap = std::hypot((S(0, 0) - S(1, 1)) / 2, S(0, 1));
  const double inverse_depth = std::sqrt(S.trace() / 2 + half_gap);
  const Matrix2d R_22 = A / inverse_depth;
  const Matrix2d M = Matrix2d::Identity() - R_22.transpose() * R_22;  // = b b^T
  const Vector2d b(std::sqrt(std::fmax(M(0, 0), 0)),
                   std::copysign(std::sqrt(std::fmax(M(1, 1), 0)), M(0, 1)));
  std::array<TargetPose, 2> poses;
  for (const int side : {0, 1}) {
    Matrix3d R;
    R.topLeftCorner<2, 2>() = R_22;
    R.block<1, 2>(2, 0) = (side == 0 ? b : -b).transpose();
    R.col(2) = R.col(0).cross(R.col(1));
    poses[std::size_t(side)] = {nearest_rotation(R_v * R), sight / inverse_depth};
  }
  return poses;
}

/// Reprojection error of a pose, px; empty when a corner is not in front of the camera.
inline std::optional<Residual> residual(const View& view, const TargetPose& pose) {
  Residual e;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d p = pose * view.corners[i];
    if (!(p.z() > 0)) return std::nullopt;
    e.segment<2>(Eigen::Index(2 * i)) = view.px_per_unit[i] * (p.hnormalized() - view.seen[i]);
  }
  return e;
}

/// Its derivative by a shift (m) and a turn (rad) of the plane, both in Camera, the turn about the
/// plane's centre.
inline Jacobian jacobian(const View& view, const TargetPose& pose) {
  Jacobian J;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d arm = pose.rotation * view.corners[i];
    const Vector3d p = arm + pose.translation;
    Eigen::Matrix<double, 2, 3> projection;
    projection << 1, 0, -p.x() / p.z(), 0, 1, -p.y() / p.z();
    projection = (view.px_per_unit[i] / p.z() * projection).eval();
    J.block<2, 3>(Eigen::Index(2 * i), 0) = projection;
    J.block<2, 3>(Eigen::Index(2 * i), 3) = -projection * skew(arm);
  }
  return J;
}

struct Solution {
  TargetPose pose;
  double squared_px = std::numeric_limits<double>::infinity();  // sum over the corners
};

inline constexpr int kMaxSteps = 50;
inline constexpr double kSmallStep = 1e-9;  // of a depth, or rad: far below what a pixel can tell

/// The minimum of the reprojection error that the start leads to (Levenberg-Marquardt).
inline Solution refined(const View& view, const TargetPose& start) {
  const auto first = residual(view, start);
  if (!first) return {};
  Solution best{start, first->squaredNorm()};
  Residual e = *first;
  double damping = 1e-4;
  for (int i = 0; i < kMaxSteps; ++i) {
    const Jacobian J = jacobian(view, best.pose);
    Eigen::Matrix<double, 6, 6> N = J.transpose() * J;
    N.diagonal() *= 1 + damping;
    const Vector6 step = N.ldlt().solve(-J.transpose() * e);
    if (!step.allFinite()) break;
    const TargetPose next{rotation_from_vector(step.tail<3>()) * best.pose.rotation,
                          best.pose.translation + step.head<3>()};
    const auto e_next = residual(view, next);
    const bool better = e_next && e_next->squaredNorm() <= best.squared_px;
    if (better) {
      best = {next, e_next->squaredNorm()};
      e = *e_next;
    }
    if (step.head<3>().norm() < kSmallStep * best.pose.translation.z() &&
        step.tail<3>().norm() < kSmallStep) {
      break;
    }
    damping = better ? damping / 10 : damping * 10;
  }
  return best;
}

}  // namespace kestrel::minima

#include "kestrel/geometry/point_pose.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "kestrel/geometry/point_homography.hpp"
#include "kestrel/geometry/twist.hpp"

namespace kestrel {
namespace {

constexpr int kMaxSteps = 15;
/// A step of this size (rad, and m per metre of distance) is rounding: no further one would help.
constexpr double kLastStep = 1e-13;
/// Points whose spread across their plane (line) is this share of that along it lie in it.
constexpr double kFlat = 1e-6;

using Points = std::vector<Eigen::Vector3d>;

bool is_finite(const Points& points, const std::vector<ImagePoint>& seen) {
  return std::all_of(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); }) &&
         std::all_of(seen.begin(), seen.end(),
                     [](const ImagePoint& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

/// Sum of the outer products of rows (L_x, L_y) and with the residual: the normal equations.
struct NormalEquations {
  Matrix6d A = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();

  void add(const Vector6d& row, double residual) {
    A.noalias() += row * row.transpose();
    b += residual * row;
  }
};

/// Those of a pose; empty when a point is not in front of the camera.
std::optional<NormalEquations> equations(const TargetPose& pose, const Points& points,
                                         const std::vector<ImagePoint>& seen) {
  NormalEquations sum;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = pose * points[i];
    if (!(p.z() > 0)) return std::nullopt;
    const double w = 1 / p.z();
    const double x = p.x() * w;
    const double y = p.y() * w;
    const Vector6d row_x = (Vector6d() << -w, 0, x * w, x * y, -(1 + x * x), y).finished();
    const Vector6d row_y = (Vector6d() << 0, -w, y * w, 1 + y * y, -x * y, -x).finished();
    sum.add(row_x, x - seen[i].x);
    sum.add(row_y, y - seen[i].y);
  }
  return sum;
}

/// Gauss-Newton from a start: the virtual camera moves until it sees what was seen.
std::optional<TargetPose> refined(TargetPose pose, const Points& points,
                                  const std::vector<ImagePoint>& seen) {
  for (int k = 0; k < kMaxSteps; ++k) {
    const auto sum = equations(pose, points, seen);
    if (!sum) return std::nullopt;
    const Vector6d v = -sum->A.ldlt().solve(sum->b);
    if (!v.allFinite()) return std::nullopt;
    const Displacement back = exponential(v, -1);
    pose = {back.rotation * pose.rotation, back.rotation * pose.translation + back.translation};
    const double distance = pose.translation.norm();
    if (v.head<3>().norm() < kLastStep * distance && v.tail<3>().norm() < kLastStep) break;
  }
  for (const Eigen::Vector3d& p : points) {
    if (!((pose * p).z() > 0)) return std::nullopt;
  }
  return TargetPose{nearest_rotation(pose.rotation), pose.translation};
}

/// The points' own frame: origin at their centre, axes along their spread, the least of it last.
struct OwnFrame {
  TargetPose target_from_own;  // its numbers; the frame's name does not matter
  Eigen::Vector3d spread_m;    // standard deviation along each axis, falling
};

OwnFrame own_frame(const Points& points) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) centre += p / double(points.size());
  Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) C += (p - centre) * (p - centre).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(C / double(points.size()));
  Eigen::Matrix3d R = axes.eigenvectors().rowwise().reverse();
  if (R.determinant() < 0) R.col(2) = -R.col(2);
  return {{R, centre}, axes.eigenvalues().reverse().cwiseMax(0).cwiseSqrt()};
}

/// Camera from a plane's frame by the homography of its (x, y): the first two columns are those of
/// the rotation, up to one scale.
std::optional<TargetPose> start_on_plane(const Points& own, const std::vector<ImagePoint>& seen) {
  std::vector<ImagePoint> plane;
  for (const Eigen::Vector3d& p : own) plane.push_back({p.x(), p.y()});
  const auto H = point_homography(plane, seen);
  if (!H) return std::nullopt;
  const double scale = 2 / (H->col(0).norm() + H->col(1).norm());
  Eigen::Matrix3d R;
  R << scale * H->col(0), scale * H->col(1), scale * scale * H->col(0).cross(H->col(1));
  if (!R.allFinite()) return std::nullopt;
  return TargetPose{nearest_rotation(R), scale * H->col(2)};
}

/// Camera from the points' frame by the linear solution for the 3 x 4 projection matrix.
std::optional<TargetPose> start_in_space(const Points& own, const std::vector<ImagePoint>& seen,
                                         double unit_m) {
  using Matrix12d = Eigen::Matrix<double, 12, 12>;
  Matrix12d A = Matrix12d::Zero();
  for (std::size_t i = 0; i < own.size(); ++i) {
    const Eigen::Vector4d p = (own[i] / unit_m).homogeneous();
    Eigen::Matrix<double, 12, 1> row = Eigen::Matrix<double, 12, 1>::Zero();
    row << p, Eigen::Vector4d::Zero(), -seen[i].x * p;
    A += row * row.transpose();
    row << Eigen::Vector4d::Zero(), p, -seen[i].y * p;
    A += row * row.transpose();
  }
  const Eigen::Matrix<double, 12, 1> h =
      Eigen::SelfAdjointEigenSolver<Matrix12d>(A).eigenvectors().col(0);
  Eigen::Matrix<double, 3, 4> P;
  P << h.segment<4>(0).transpose(), h.segment<4>(4).transpose(), h.segment<4>(8).transpose();
  const double scale = std::cbrt(P.leftCols<3>().determinant());  // its sign: points in front
  if (!std::isfinite(1 / scale)) return std::nullopt;
  return TargetPose{nearest_rotation(P.leftCols<3>() / scale), P.col(3) * unit_m / scale};
}

/// The pose by the points alone, refined.
std::optional<TargetPose> found(const OwnFrame& frame, const Points& points,
                                const std::vector<ImagePoint>& seen) {
  const auto own_from_target = frame.target_from_own.inverse();
  const Eigen::Matrix3d R = own_from_target.rotation;
  Points own;
  own.reserve(points.size());
  for (const Eigen::Vector3d& p : points) own.push_back(R * p + own_from_target.translation);
  const bool flat = frame.spread_m[2] <= kFlat * frame.spread_m[0];
  if (own.size() < (flat ? 4U : 6U)) return std::nullopt;
  const auto start =
      flat ? start_on_plane(own, seen) : start_in_space(own, seen, frame.spread_m[0]);
  if (!start) return std::nullopt;
  return refined(
      {start->rotation * R, start->rotation * own_from_target.translation + start->translation},
      points, seen);
}

}  // namespace

std::optional<TargetPose> point_pose(const std::vector<Eigen::Vector3d>& points_in_target,
                                     const std::vector<ImagePoint>& seen,
                                     const std::optional<TargetPose>& previous) {
  if (points_in_target.size() < 3 || points_in_target.size() != seen.size()) return std::nullopt;
  if (!is_finite(points_in_target, seen)) return std::nullopt;
  const OwnFrame frame = own_frame(points_in_target);
  if (!(frame.spread_m[1] > kFlat * frame.spread_m[0])) return std::nullopt;
  if (previous) {
    auto pose = refined(*previous, points_in_target, seen);
    if (pose) return pose;
  }
  return found(frame, points_in_target, seen);
}

}  // namespace kestrel

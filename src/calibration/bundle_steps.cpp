#include "bundle_steps.hpp"

#include <cmath>
#include <stdexcept>

#include <Eigen/Cholesky>

namespace kestrel {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Matrix26d = Eigen::Matrix<double, 2, 6>;

std::optional<Neighbours> neighbours(const BundleProblem& problem,
                                     const std::vector<double>& values) {
  Neighbours all;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double step = i < 4 ? 1e-3 * std::abs(values[0]) : 1e-5;
    std::vector<double> moved = values;
    moved[i] = values[i] + step;
    const auto above = camera_of(problem, moved);
    moved[i] = values[i] - step;
    const auto below = camera_of(problem, moved);
    if (!above || !below) return std::nullopt;
    all.above.push_back(*above);
    all.below.push_back(*below);
    all.distance.push_back(2 * step);
  }
  return all;
}

/// Derivative of the pixel by a motion (v, w) of the board in the camera.
Matrix26d pose_derivative(const Camera& camera, const Eigen::Vector3d& p) {
  const double w = 1 / p.z();
  const double x = p.x() * w;
  const double y = p.y() * w;
  Matrix26d by_motion;
  by_motion << w, 0, -x * w, -x * y, 1 + x * x, -y, 0, w, -y * w, -(1 + y * y), x * y, x;
  return camera.pixel_jacobian({x, y}) * by_motion;
}

Matrix6d damped(const Matrix6d& C, double damping) {
  Matrix6d D = C;
  D.diagonal() *= 1 + damping;
  return D;
}

}  // namespace

std::optional<Camera> camera_of(const BundleProblem& problem, const std::vector<double>& values) {
  try {
    return Camera(camera_with(problem.model, values, problem.size.width, problem.size.height));
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

ImagePoint projected(const Eigen::Vector3d& p) { return {p.x() / p.z(), p.y() / p.z()}; }

ViewBlocks no_blocks(Eigen::Index values) {
  ViewBlocks none;
  none.A = MatrixXd::Zero(values, values);
  none.B = MatrixXd::Zero(values, 6);
  none.a = VectorXd::Zero(values);
  return none;
}

ViewBlocks blocks(const BoardView& view, const std::vector<Eigen::Vector3d>& points,
                  const Camera& camera, const Neighbours& near, const TargetPose& pose) {
  const auto n = Eigen::Index(near.above.size());
  ViewBlocks sum = no_blocks(n);
  for (const BoardPoint& point : view.points) {
    const Eigen::Vector3d p = pose * points[std::size_t(point.id)];
    const ImagePoint m = projected(p);
    const Pixel put = camera.to_pixel(m);
    const Eigen::Vector2d r(put.u - point.in_image.u, put.v - point.in_image.v);
    const Matrix26d J_pose = pose_derivative(camera, p);
    MatrixXd J(2, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Pixel above = near.above[std::size_t(i)].to_pixel(m);
      const Pixel below = near.below[std::size_t(i)].to_pixel(m);
      J.col(i) << above.u - below.u, above.v - below.v;
      J.col(i) /= near.distance[std::size_t(i)];
    }
    add(sum, J, J_pose, r);
  }
  return sum;
}

Reduced reduced(const std::vector<ViewBlocks>& views, double damping) {
  MatrixXd S = views.front().A;
  VectorXd s = views.front().a;
  for (std::size_t i = 1; i < views.size(); ++i) {
    S += views[i].A;
    s += views[i].a;
  }
  S.diagonal() *= 1 + damping;
  for (const ViewBlocks& view : views) {
    const MatrixXd E = damped(view.C, damping).ldlt().solve(view.B.transpose());
    S.noalias() -= view.B * E;
    s.noalias() -= E.transpose() * view.c;
  }
  return {S, s};
}

TargetPose moved(const TargetPose& pose, const Vector6d& step) {
  // pose_derivative counts the motion of the board's points: p + v + w x p.
  const Displacement d = exponential(step, 1);
  return {nearest_rotation(d.rotation * pose.rotation),
          d.rotation * pose.translation + d.translation};
}

BundleState stepped(const BundleState& state, const std::vector<ViewBlocks>& views,
                    double damping) {
  const Reduced equations = reduced(views, damping);
  const VectorXd step = -equations.S.ldlt().solve(equations.s);
  BundleState next = state;
  for (std::size_t i = 0; i < next.values.size(); ++i) next.values[i] += step[Eigen::Index(i)];
  for (std::size_t i = 0; i < next.poses.size(); ++i) {
    const Vector6d right = -(views[i].c + views[i].B.transpose() * step);
    next.poses[i] = moved(state.poses[i], damped(views[i].C, damping).ldlt().solve(right));
  }
  return next;
}

std::optional<std::vector<ViewBlocks>> all_blocks(const BundleProblem& problem,
                                                  const BundleState& state) {
  const auto camera = camera_of(problem, state.values);
  const auto near = neighbours(problem, state.values);
  if (!camera || !near) return std::nullopt;
  std::vector<ViewBlocks> all;
  for (std::size_t i = 0; i < problem.views.size(); ++i)
    all.push_back(blocks(problem.views[i], problem.points, *camera, *near, state.poses[i]));
  return all;
}

}  // namespace kestrel

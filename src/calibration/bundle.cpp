#include "bundle.hpp"

#include <cmath>

#include <Eigen/Cholesky>

#include "kestrel/geometry/point_pose.hpp"

#include "bundle_steps.hpp"

namespace kestrel {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxSteps = 100;
constexpr double kSmallGain = 1e-14;  // of the sum of squares: below it is rounding

/// Sum of squares, px^2; not finite when a point is put nowhere.
double sum_px2(const BundleProblem& problem, const BundleState& state) {
  const auto camera = camera_of(problem, state.values);
  if (!camera) return std::nan("");
  double sum = 0;
  for (std::size_t i = 0; i < problem.views.size(); ++i) {
    const auto put = residuals(problem.views[i], problem.points, *camera, state.poses[i]);
    if (!put) return std::nan("");
    for (const PointResidual& r : *put) sum += r.du_px * r.du_px + r.dv_px * r.dv_px;
  }
  return sum;
}

MatrixXd inverse_of(const MatrixXd& S) {
  // The values differ by orders of magnitude: scaled to a unit diagonal first.
  const VectorXd scale = S.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd unit = scale.asDiagonal() * S * scale.asDiagonal();
  const Eigen::LLT<MatrixXd> factor(unit);
  if (!unit.allFinite() || factor.info() != Eigen::Success || factor.rcond() < 1e-12) return {};
  const MatrixXd inverse = factor.solve(MatrixXd::Identity(S.rows(), S.cols()));
  return scale.asDiagonal() * inverse * scale.asDiagonal();
}

}  // namespace

std::optional<std::vector<PointResidual>> residuals(const BoardView& view,
                                                    const std::vector<Eigen::Vector3d>& points,
                                                    const Camera& camera, const TargetPose& pose) {
  std::vector<PointResidual> all;
  for (const BoardPoint& point : view.points) {
    const Eigen::Vector3d p = pose * points[std::size_t(point.id)];
    const Pixel put = camera.to_pixel(projected(p));
    if (!(p.z() > 0) || !std::isfinite(put.u) || !std::isfinite(put.v)) return std::nullopt;
    all.push_back({point.in_image, put.u - point.in_image.u, put.v - point.in_image.v});
  }
  return all;
}

std::optional<BundleFit> bundle(const BundleProblem& problem, const BundleState& start) {
  return minimum({[&](const BundleState& state) { return sum_px2(problem, state); },
                  [&](const BundleState& state) { return all_blocks(problem, state); }},
                 start);
}

std::optional<BundleFit> minimum(const BundleTerms& terms, const BundleState& start) {
  BundleFit fit{start, terms.sum_px2(start), {}};
  if (!std::isfinite(fit.sum_px2)) return std::nullopt;
  auto views = terms.blocks(fit.state);
  double damping = 1e-6;
  for (int k = 0; k < kMaxSteps && views && damping < 1e12; ++k) {
    const BundleState next = stepped(fit.state, *views, damping);
    const double sum = terms.sum_px2(next);
    if (!(sum < fit.sum_px2)) {
      damping *= 10;
      continue;
    }
    const bool done = fit.sum_px2 - sum <= kSmallGain * fit.sum_px2;
    fit.state = next;
    fit.sum_px2 = sum;
    damping /= 10;
    views = terms.blocks(fit.state);
    if (done) break;
  }
  if (views) fit.inverse = inverse_of(reduced(*views, 0).S);
  return fit;
}

std::optional<TargetPose> board_pose(const BoardView& view,
                                     const std::vector<Eigen::Vector3d>& points,
                                     const Camera& camera) {
  std::vector<Eigen::Vector3d> on_board;
  std::vector<ImagePoint> seen;
  for (const BoardPoint& point : view.points) {
    const ImagePoint m = camera.to_image_point(point.in_image);
    if (!std::isfinite(m.x) || !std::isfinite(m.y)) return std::nullopt;
    on_board.push_back(points[std::size_t(point.id)]);
    seen.push_back(m);
  }
  auto pose = point_pose(on_board, seen);
  // From the least squares of the plane to that of the pixels it is a small way.
  for (int k = 0; k < 10 && pose; ++k) {
    const ViewBlocks sum = blocks(view, points, camera, {}, *pose);
    const Vector6d step = -sum.C.ldlt().solve(sum.c);
    if (!step.allFinite()) return std::nullopt;
    pose = moved(*pose, step);
    if (step.norm() < 1e-12) break;
  }
  return pose;
}

}  // namespace kestrel

#include "visp_bundle.hpp"

#include <array>
#include <cmath>

#include "bundle.hpp"
#include "bundle_steps.hpp"

namespace kestrel {
namespace {

using Eigen::Vector4d;

constexpr Eigen::Index kValues = 6;  // px, py, u0, v0, kud, kdu

/// Where both polynomials put a point less where it was seen, px.
Vector4d residual(const std::vector<double>& a, const ImagePoint& m, const Pixel& seen) {
  const double du = seen.u - a[2];
  const double dv = seen.v - a[3];
  const double outward = 1 + a[4] * (m.x * m.x + m.y * m.y);
  const double x = du / a[0];
  const double y = dv / a[1];
  const double inward = 1 + a[5] * (x * x + y * y);
  return {a[0] * m.x * outward - du, a[1] * m.y * outward - dv, a[0] * m.x - inward * du,
          a[1] * m.y - inward * dv};
}

/// Derivative of the residual by the values; all but px and py are polynomials of at most second
/// degree, so that central differences are exact but for rounding, and those are nearly so.
Eigen::Matrix<double, 4, kValues> by_values(const std::vector<double>& a, const ImagePoint& m,
                                            const Pixel& seen) {
  Eigen::Matrix<double, 4, kValues> J;
  for (Eigen::Index i = 0; i < kValues; ++i) {
    const double step = i < 4 ? 1e-5 * a[0] : 1e-5;
    std::vector<double> above = a;
    std::vector<double> below = a;
    above[std::size_t(i)] += step;
    below[std::size_t(i)] -= step;
    J.col(i) = (residual(above, m, seen) - residual(below, m, seen)) / (2 * step);
  }
  return J;
}

/// Derivative of the residual by a motion (v, w) of the board in the camera.
Eigen::Matrix<double, 4, 6> by_pose(const std::vector<double>& a, const Eigen::Vector3d& p) {
  const ImagePoint m = projected(p);
  const double w = 1 / p.z();
  Eigen::Matrix<double, 2, 6> by_motion;
  by_motion << w, 0, -m.x * w, -m.x * m.y, 1 + m.x * m.x, -m.y,  //
      0, w, -m.y * w, -(1 + m.y * m.y), m.x * m.y, m.x;
  const double outward = 1 + a[4] * (m.x * m.x + m.y * m.y);
  Eigen::Matrix<double, 4, 2> by_point;
  by_point << a[0] * (outward + 2 * a[4] * m.x * m.x), a[0] * 2 * a[4] * m.x * m.y,  //
      a[1] * 2 * a[4] * m.x * m.y, a[1] * (outward + 2 * a[4] * m.y * m.y),          //
      a[0], 0, 0, a[1];
  return by_point * by_motion;
}

double sum_px2(const BundleProblem& problem, const BundleState& state) {
  double sum = 0;
  for (std::size_t i = 0; i < problem.views.size(); ++i) {
    for (const BoardPoint& point : problem.views[i].points) {
      const Eigen::Vector3d p = state.poses[i] * problem.points[std::size_t(point.id)];
      if (!(p.z() > 0)) return std::nan("");
      sum += residual(state.values, projected(p), point.in_image).squaredNorm();
    }
  }
  return sum;
}

ViewBlocks blocks_of(const BundleProblem& problem, const BundleState& state, std::size_t view) {
  ViewBlocks sum = no_blocks(kValues);
  for (const BoardPoint& point : problem.views[view].points) {
    const Eigen::Vector3d p = state.poses[view] * problem.points[std::size_t(point.id)];
    const Vector4d r = residual(state.values, projected(p), point.in_image);
    add(sum, by_values(state.values, projected(p), point.in_image), by_pose(state.values, p), r);
  }
  return sum;
}

BundleTerms terms_of(const BundleProblem& problem) {
  const auto all_blocks_of = [&problem](const BundleState& state) {
    std::vector<ViewBlocks> all;
    for (std::size_t i = 0; i < problem.views.size(); ++i)
      all.push_back(blocks_of(problem, state, i));
    return std::optional(all);
  };
  return {[&problem](const BundleState& state) { return sum_px2(problem, state); }, all_blocks_of};
}

/// What each of the four rows leaves over counts, and each of the two coordinates stands in two of
/// them: the inverse of the normal matrix holds for twice as many measurements as there are.
Calibration calibration_of(const BundleFit& fit, const Calibration& start, std::size_t points) {
  static constexpr std::array<const char*, 6> kNames = {"fx", "fy", "cx", "cy", "kud", "kdu"};
  const std::vector<double>& a = fit.state.values;
  Calibration out;
  out.model = start.model;
  out.camera = {a[0], a[1], a[2], a[3], start.camera.width, start.camera.height, Lens::VispRadial};
  out.camera.distortion = {a[4], a[5]};
  const double unknowns = double(kValues) + 6 * double(fit.state.poses.size());
  out.noise_px = std::sqrt(fit.sum_px2 / 2 / std::max(1.0, 2 * double(points) - unknowns));
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const auto k = Eigen::Index(i);
    out.parameters.push_back(
        {kNames[i], a[i], out.noise_px * std::sqrt(2 * fit.inverse(k, k)), i < 4 ? "px" : ""});
  }
  return out;
}

}  // namespace

std::optional<Calibration> solve_as_visp(const std::vector<BoardView>& views, const Board& board,
                                         const Calibration& start) {
  const BundleProblem problem{
      start.model, views, board_points(board), {start.camera.width, start.camera.height}};
  BundleState state;
  const double k1 = start.camera.distortion[0];
  state.values = {start.camera.px, start.camera.py, start.camera.u0, start.camera.v0, k1, -k1};
  std::size_t points = 0;
  for (const SolvedView& view : start.views) {
    state.poses.push_back(view.camera_from_board);
    points += view.residuals.size();
  }
  const auto fit = minimum(terms_of(problem), state);
  if (!fit || fit->inverse.size() == 0) return std::nullopt;
  return calibration_of(*fit, start, points);
}

}  // namespace kestrel

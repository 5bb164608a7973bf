#include "kestrel/calibration/camera_solver.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bundle.hpp"
#include "camera_start.hpp"

namespace kestrel {
namespace {

void check_view(const BoardView& view, std::size_t points, ImageSize size) {
  const auto fail = [&](const std::string& what) {
    throw CalibrationError(view.name + ": " + what);
  };
  if (view.points.size() < 4)
    fail(fmt::format("only {} points of the board; 4 are needed", view.points.size()));
  for (const BoardPoint& point : view.points) {
    const Pixel& p = point.in_image;
    if (!std::isfinite(p.u) || !std::isfinite(p.v))
      fail("a point's place is not finite; leave the picture out");
    if (p.u < -0.5 || p.v < -0.5 || p.u > size.width - 0.5 || p.v > size.height - 0.5)
      fail(fmt::format("a point at ({:.1f}, {:.1f}) lies outside the {} x {} image", p.u, p.v,
                       size.width, size.height));
    if (point.id < 0 || std::size_t(point.id) >= points)
      fail(fmt::format("point {} is none of the board's {}", point.id, points));
  }
}

void check(const BundleProblem& problem) {
  if (problem.size.width <= 0 || problem.size.height <= 0)
    throw CalibrationError("the size of the images is not known");
  if (problem.views.size() < 3) {
    throw CalibrationError(fmt::format(
        "the board is seen in {} pictures only; take 10 to 20, and tilt it differently in each",
        problem.views.size()));
  }
  for (const BoardView& view : problem.views) check_view(view, problem.points.size(), problem.size);
}

SolvedView solved(const BoardView& view, const TargetPose& pose,
                  const std::vector<PointResidual>& put) {
  SolvedView out{view.name, pose, put, 0, 0};
  double sum = 0;
  for (const PointResidual& r : put) {
    const double square = r.du_px * r.du_px + r.dv_px * r.dv_px;
    sum += square;
    out.worst_px = std::max(out.worst_px, std::sqrt(square));
  }
  out.rms_px = std::sqrt(sum / double(put.size()));
  return out;
}

std::vector<ParameterEstimate> estimates(const BundleProblem& problem, const BundleFit& fit,
                                         double noise_px) {
  std::vector<ParameterEstimate> all;
  const std::vector<ModelParameter> parameters = parameters_of(problem.model);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto k = Eigen::Index(i);
    all.push_back({parameters[i].name, fit.state.values[i], noise_px * std::sqrt(fit.inverse(k, k)),
                   parameters[i].unit});
  }
  return all;
}

Calibration calibration_of(const BundleProblem& problem, const BundleFit& fit) {
  Calibration out;
  out.model = problem.model;
  out.camera =
      camera_with(problem.model, fit.state.values, problem.size.width, problem.size.height);
  const Camera camera(out.camera);
  std::size_t points = 0;
  for (std::size_t i = 0; i < problem.views.size(); ++i) {
    const auto put = residuals(problem.views[i], problem.points, camera, fit.state.poses[i]);
    out.views.push_back(solved(problem.views[i], fit.state.poses[i], *put));
    points += put->size();
  }
  const double unknowns = double(fit.state.values.size() + 6 * problem.views.size());
  out.rms_px = std::sqrt(fit.sum_px2 / double(points));
  out.noise_px = std::sqrt(fit.sum_px2 / std::max(1.0, 2 * double(points) - unknowns));
  out.parameters = estimates(problem, fit, out.noise_px);
  return out;
}

}  // namespace

Calibration solve_camera(const std::vector<BoardView>& views, const Board& board, ImageSize size,
                         CameraModel model) {
  const BundleProblem problem{model, views, board_points(board), size};
  check(problem);
  std::optional<BundleFit> best;
  for (const BundleState& start : camera_starts(problem)) {
    const auto fit = bundle(problem, start);
    if (fit && fit->inverse.size() > 0 && (!best || fit->sum_px2 < best->sum_px2)) best = fit;
  }
  if (!best) {
    throw CalibrationError(
        "these views do not tell the camera's numbers apart; tilt the board by 20 to 45 degrees "
        "to the left, right, up and down, and check that the board is the one named");
  }
  return calibration_of(problem, *best);
}

SolvedView solve_view(const BoardView& view, const Board& board, const Camera& camera) {
  const std::vector<Eigen::Vector3d> points = board_points(board);
  const auto pose = board_pose(view, points, camera);
  const auto put = pose ? residuals(view, points, camera, *pose) : std::nullopt;
  return put && !put->empty() ? solved(view, *pose, *put) : SolvedView{view.name, {}, {}, 0, 0};
}

}  // namespace kestrel

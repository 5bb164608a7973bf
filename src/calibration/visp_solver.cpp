#include "kestrel/calibration/visp_solver.hpp"

#include <algorithm>
#include <cmath>

#include "kestrel/io/module.hpp"

#include "visp_bundle.hpp"
#include "visp_module.hpp"

namespace kestrel {
namespace {

std::vector<std::vector<VispPoint>> visp_views(const std::vector<BoardView>& views,
                                               const Board& board) {
  const std::vector<Eigen::Vector3d> points = board_points(board);
  std::vector<std::vector<VispPoint>> all;
  for (const BoardView& view : views) {
    all.emplace_back();
    for (const BoardPoint& point : view.points) {
      const Eigen::Vector3d& p = points[std::size_t(point.id)];
      all.back().push_back({p.x(), p.y(), point.in_image});
    }
  }
  return all;
}

/// Root mean square distance of all points under a camera, the poses fitted to it.
double rms_px(const std::vector<BoardView>& views, const Board& board, const Camera& camera) {
  double sum_px2 = 0;
  std::size_t points = 0;
  for (const BoardView& view : views) {
    const SolvedView solved = solve_view(view, board, camera);
    if (solved.residuals.empty()) return std::nan("");
    sum_px2 += solved.rms_px * solved.rms_px * double(solved.residuals.size());
    points += solved.residuals.size();
  }
  return std::sqrt(sum_px2 / double(points));
}

/// The camera by its way to the pixel alone: a pinhole's inverse is exact, kdu is not.
Camera outward(CameraParameters camera) {
  if (camera.lens == Lens::VispRadial) {
    camera.lens = Lens::PlumbBob;
    camera.distortion = {camera.distortion[0]};
  }
  return Camera(camera);
}

bool is_sound(const CameraParameters& p) {
  return std::isfinite(p.px) && std::isfinite(p.py) && std::isfinite(p.u0) && std::isfinite(p.v0) &&
         p.px > 0 && p.py > 0 && std::isfinite(p.distortion[0]) && std::isfinite(p.distortion[1]);
}

}  // namespace

std::vector<double> visp_values(const VispCheck& check) {
  const CameraParameters& c = check.visp;
  std::vector<double> values{c.px, c.py, c.u0, c.v0};
  if (c.lens == Lens::VispRadial) {
    values.push_back(c.distortion[0]);
    values.push_back(c.distortion[1]);
  }
  return values;
}

std::optional<VispCheck> visp_check(const std::vector<BoardView>& views, const Board& board,
                                    ImageSize size, CameraModel model) {
  if (model == CameraModel::KannalaBrandt) return std::nullopt;
  const bool straight = model == CameraModel::None;
  VispCheck check;
  check.ours = solve_camera(views, board, size, straight ? CameraModel::None : CameraModel::Radial);
  if (!straight) {
    const auto same = solve_as_visp(views, board, check.ours);
    if (!same) return std::nullopt;
    check.ours = *same;
    check.ours.rms_px = rms_px(views, board, outward(check.ours.camera));
  }
  // ViSP begins at a plain guess, not at our answer: it is to find the camera by itself.
  CameraParameters start{600.0 * size.width / 640,
                         600.0 * size.width / 640,
                         size.width / 2.0,
                         size.height / 2.0,
                         size.width,
                         size.height};
  const auto found =
      module_functions<VispModule>("visp_calibration")
          .calibrate(visp_views(views, board), start, straight ? Lens::Pinhole : Lens::VispRadial);
  if (!found || !is_sound(*found)) return std::nullopt;
  check.visp = *found;
  check.visp_rms_px = rms_px(views, board, outward(*found));
  const std::vector<double> theirs = visp_values(check);
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    const ParameterEstimate& mine = check.ours.parameters[i];
    check.largest_deviations =
        std::max(check.largest_deviations, std::abs(theirs[i] - mine.value) / mine.deviation);
  }
  return check;
}

}  // namespace kestrel

#include "kestrel/calibration/view_advice.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "kestrel/geometry/homography.hpp"

namespace kestrel {
namespace {

/// The homography from the board's plane, in units of its spacing, to the image.
std::optional<Homography> board_homography(const BoardView& view, const Board& board) {
  const std::vector<Eigen::Vector3d> points = board_points(board);
  std::vector<PixelPair> pairs;
  for (const BoardPoint& point : view.points) {
    if (point.id < 0 || std::size_t(point.id) >= points.size()) return std::nullopt;
    const Eigen::Vector3d p = points[std::size_t(point.id)] / board.spacing_m;
    pairs.push_back({{p.x(), p.y()}, point.in_image});
  }
  return fit_homography(pairs);
}

/// Pixels by units of the board, at a place of it.
Eigen::Matrix2d slope(const Eigen::Matrix3d& H, const Eigen::Vector2d& at) {
  const Eigen::Vector3d q = H * at.homogeneous();
  const Eigen::Vector2d put = q.hnormalized();
  return (H.topLeftCorner<2, 2>() - put * H.bottomLeftCorner<1, 2>()) / q.z();
}

/// A kind of view that is wanted, how to ask for it, and whether a view is one.
struct Wish {
  std::string words;
  std::function<bool(const ViewShape&)> is_met;
};

std::vector<Wish> wishes(ImageSize size, const GuideOptions& o) {
  const double u = o.border * size.width;
  const double v = o.border * size.height;
  const double right = size.width - u;
  const double bottom = size.height - v;
  return {
      {"move the board to the left border", [=](const auto& s) { return s.reach.u < u; }},
      {"move the board to the right border",
       [=](const auto& s) { return s.reach.u + s.reach.width > right; }},
      {"move the board to the upper border", [=](const auto& s) { return s.reach.v < v; }},
      {"move the board to the lower border",
       [=](const auto& s) { return s.reach.v + s.reach.height > bottom; }},
      {"turn its right side away", [=](const auto& s) { return s.lean_right > o.lean_rad; }},
      {"turn its left side away", [=](const auto& s) { return s.lean_right < -o.lean_rad; }},
      {"turn its lower side away", [=](const auto& s) { return s.lean_down > o.lean_rad; }},
      {"turn its upper side away", [=](const auto& s) { return s.lean_down < -o.lean_rad; }},
      {"bring it nearer, until it fills half of the image's width",
       [=](const auto& s) { return s.size > o.near_size; }},
  };
}

/// Whether two views show nearly the same.
bool are_alike(const ViewShape& a, const ViewShape& b, ImageSize size, const GuideOptions& o) {
  return std::abs(a.centre.u - b.centre.u) < o.smallest_change * size.width &&
         std::abs(a.centre.v - b.centre.v) < o.smallest_change * size.height &&
         std::abs(a.size - b.size) < o.smallest_change &&
         std::abs(a.lean_right - b.lean_right) < 2 * o.smallest_change &&
         std::abs(a.lean_down - b.lean_down) < 2 * o.smallest_change;
}

/// Why a view is not taken; empty when it is.
std::string objection(const std::vector<ViewShape>& kept, const std::optional<ViewShape>& now,
                      ImageSize size, const GuideOptions& o) {
  if (!now) return "no board is seen";
  if (!(now->edge_width_px < o.largest_edge_px)) {
    return fmt::format("blurred: edges are {:.0f} px wide; hold still, add light or focus",
                       now->edge_width_px);
  }
  const bool is_known = std::any_of(kept.begin(), kept.end(), [&](const ViewShape& other) {
    return are_alike(*now, other, size, o);
  });
  return is_known ? "like a view that is kept" : "";
}

}  // namespace

void GuideOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(views >= 3, "views: at least 3");
  require(lean_rad > 0 && lean_rad < 1.4, "lean_rad: more than 0, less than 1.4");
  require(border > 0 && border < 0.5, "border: more than 0, less than 0.5");
  require(near_size > 0 && near_size < 1, "near_size: more than 0, less than 1");
  require(largest_edge_px > 1, "largest_edge_px: more than 1");
  require(largest_motion > 0 && largest_motion < 1, "largest_motion: more than 0, less than 1");
  require(smallest_change > 0 && smallest_change < 1, "smallest_change: more than 0, less than 1");
}

std::optional<ViewShape> view_shape(const BoardView& view, const Board& board, ImageSize size,
                                    double edge_width_px) {
  const auto fit = board_homography(view, board);
  if (!fit) return std::nullopt;
  const Eigen::Vector3d last = board_points(board).back() / board.spacing_m;
  const Eigen::Vector2d middle = last.head<2>() / 2;
  const Eigen::Matrix2d J = slope(fit->H, middle);
  if (!J.allFinite() || std::abs(J.determinant()) < 1e-9) return std::nullopt;
  const Eigen::Vector2d stretch = Eigen::JacobiSVD<Eigen::Matrix2d>(J).singularValues();
  const double tilt = std::acos(std::clamp(stretch[1] / stretch[0], 0.0, 1.0));
  // The third row of H is depth up to scale: its slope over the image tells the direction.
  const double depth = (fit->H * middle.homogeneous()).z();
  const Eigen::Vector2d deeper =
      J.transpose().inverse() * fit->H.bottomLeftCorner<1, 2>().transpose() / depth;
  const Eigen::Vector2d direction = deeper.norm() > 0 ? Eigen::Vector2d(deeper.normalized())
                                                      : Eigen::Vector2d(Eigen::Vector2d::Zero());
  ViewShape shape;
  shape.centre = *fit * Pixel{middle.x(), middle.y()};
  std::vector<Pixel> seen;
  for (const BoardPoint& point : view.points) seen.push_back(point.in_image);
  shape.reach = bounding_box(seen);
  shape.size = std::sqrt(std::abs(J.determinant()) * last.x() * last.y() /
                         (double(size.width) * size.height));
  shape.lean_right = tilt * direction.x();
  shape.lean_down = tilt * direction.y();
  shape.edge_width_px = edge_width_px;
  return shape;
}

ViewAdvice view_advice(const std::vector<ViewShape>& kept, const std::optional<ViewShape>& now,
                       ImageSize size, const GuideOptions& options) {
  options.check();
  ViewAdvice advice;
  advice.reason = objection(kept, now, size, options);
  advice.take = advice.reason.empty();
  std::vector<ViewShape> all = kept;
  if (advice.take) all.push_back(*now);
  const std::vector<Wish> wanted = wishes(size, options);
  for (const Wish& wish : wanted)
    if (std::none_of(all.begin(), all.end(), wish.is_met)) advice.missing.push_back(wish.words);
  const int more = options.views - int(all.size());
  if (more > 0) advice.missing.push_back(fmt::format("{} more different views", more));
  const double met = double(wanted.size() - advice.missing.size() + (more > 0 ? 1 : 0));
  const double taken = std::min(1.0, double(all.size()) / options.views);
  advice.progress = (met / double(wanted.size()) + taken) / 2;
  return advice;
}

}  // namespace kestrel

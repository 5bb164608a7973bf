#include "kestrel/calibration/view_collector.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "kestrel/calibration/board_detection.hpp"

namespace kestrel {
namespace {

/// Root mean square motion of the points that both pictures show; infinite when they share none.
double motion_px(const std::vector<BoardPoint>& before, const std::vector<BoardPoint>& now) {
  double sum_px2 = 0;
  int count = 0;
  for (const BoardPoint& a : before) {
    for (const BoardPoint& b : now) {
      if (a.id != b.id) continue;
      const double d = distance(a.in_image, b.in_image);
      sum_px2 += d * d;
      ++count;
    }
  }
  return count == 0 ? std::numeric_limits<double>::infinity() : std::sqrt(sum_px2 / count);
}

}  // namespace

ViewCollector::ViewCollector(const Board& board, Choose choose, const GuideOptions& options)
    : board_(board), choose_(choose), options_(options) {
  board_.check();
  options_.check();
}

Offered ViewCollector::offer(const std::string& name, const cv::Mat& gray) {
  if (size_.width == 0) size_ = {gray.cols, gray.rows};
  if (gray.cols != size_.width || gray.rows != size_.height) {
    return {false,
            fmt::format("is {} x {} px, the first is {} x {}", gray.cols, gray.rows, size_.width,
                        size_.height),
            {},
            0};
  }
  const BoardView view{name, find_board(gray, board_)};
  const bool is_still = choose_ != Choose::Live ||
                        motion_px(before_, view.points) < options_.largest_motion * gray.cols;
  before_ = view.points;
  Offered offered = view.points.empty() ? not_kept("no board of this kind is found")
                                        : judged(view, gray, is_still);
  offered.points = view.points;
  return offered;
}

Offered ViewCollector::not_kept(const std::string& why) const {
  if (choose_ == Choose::All) return {false, why, {}, 0};
  const ViewAdvice advice = view_advice(shapes_, std::nullopt, size_, options_);
  return {false, why, advice.missing, advice.progress};
}

Offered ViewCollector::judged(const BoardView& view, const cv::Mat& gray, bool is_still) {
  const double edge_px = edge_width_px(gray, view.points);
  const auto shape = view_shape(view, board_, size_, edge_px);
  if (!shape) return not_kept("the points found are in no plane's order");
  const ViewAdvice advice = view_advice(shapes_, shape, size_, options_);
  if (choose_ != Choose::All && !advice.take) return not_kept(advice.reason);
  if (!is_still) return not_kept("hold still");
  keep(view, *shape, gray);
  return {true, fmt::format("{} points, edges {:.1f} px wide", view.points.size(), edge_px),
          advice.missing, advice.progress};
}

void ViewCollector::keep(const BoardView& view, const ViewShape& shape, const cv::Mat& gray) {
  const bool is_largest = views_.empty() || shape.size > shapes_[largest_view_].size;
  views_.push_back(view);
  shapes_.push_back(shape);
  if (!is_largest) return;
  largest_picture_ = gray.clone();
  largest_view_ = views_.size() - 1;
}

}  // namespace kestrel

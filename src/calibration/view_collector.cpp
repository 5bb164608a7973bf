#include "kestrel/calibration/view_collector.hpp"

#include <utility>

#include <fmt/format.h>

#include "kestrel/calibration/board_detection.hpp"

namespace kestrel {

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
  const std::vector<BoardPoint> points = find_board(gray, board_);
  if (!points.empty()) return kept(name, gray, points);
  if (choose_ == Choose::All) return {false, "no board of this kind is found", {}, 0};
  const ViewAdvice advice = view_advice(shapes_, std::nullopt, size_, options_);
  return {false, advice.reason, advice.missing, advice.progress};
}

Offered ViewCollector::kept(const std::string& name, const cv::Mat& gray,
                            std::vector<BoardPoint> points) {
  const BoardView view{name, std::move(points)};
  const double edge_px = edge_width_px(gray, view.points);
  const auto shape = view_shape(view, board_, size_, edge_px);
  if (!shape) return {false, "the points found are in no plane's order", {}, 0};
  const ViewAdvice advice = view_advice(shapes_, shape, size_, options_);
  if (choose_ == Choose::Guided && !advice.take)
    return {false, advice.reason, advice.missing, advice.progress};
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

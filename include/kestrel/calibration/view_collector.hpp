#pragma once

#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/calibration/board.hpp"
#include "kestrel/calibration/view_advice.hpp"

namespace kestrel {

/// Which pictures are kept.
enum class Choose {
  All,     // each that shows the board: pictures that somebody has chosen
  Guided,  // those that view_advice takes: frames of a video
  Live,    // of these, those in which the board has not moved since the picture before: a camera's
};

/// What came of a picture.
struct Offered {
  bool kept = false;
  std::string what;                  // for a human: points found, or why it is not kept
  std::vector<std::string> missing;  // as ViewAdvice
  double progress = 0;
  std::vector<BoardPoint> points{};  // of the board, where it is seen; empty: it is not
};

/// Collects the views of a board from pictures, one after the other.
class ViewCollector {
 public:
  /// Throws std::invalid_argument for a board or options that do not check.
  ViewCollector(const Board& board, Choose choose, const GuideOptions& options = {});

  /// Looks for the board in a picture, 8-bit grey, and keeps the view or not. Pictures of another
  /// size than the first are not kept.
  Offered offer(const std::string& name, const cv::Mat& gray);

  const std::vector<BoardView>& views() const { return views_; }
  /// Of the pictures; 0 x 0 before the first.
  ImageSize size() const { return size_; }
  /// The picture that shows the board largest, and its place among the views; empty for no views.
  const cv::Mat& largest_picture() const { return largest_picture_; }
  std::size_t largest_view() const { return largest_view_; }

 private:
  Offered judged(const BoardView& view, const cv::Mat& gray, bool is_still);
  Offered not_kept(const std::string& why) const;
  void keep(const BoardView& view, const ViewShape& shape, const cv::Mat& gray);

  Board board_;
  Choose choose_;
  GuideOptions options_;
  ImageSize size_;
  std::vector<BoardView> views_;
  std::vector<ViewShape> shapes_;
  std::vector<BoardPoint> before_;  // where the picture before showed the board
  cv::Mat largest_picture_;
  std::size_t largest_view_ = 0;
};

}  // namespace kestrel

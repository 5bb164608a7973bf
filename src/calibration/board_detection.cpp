#include "kestrel/calibration/board_detection.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "dictionary.hpp"

namespace kestrel {
namespace {

using Corners = std::vector<cv::Point2f>;

/// Wider pictures are searched at this width: the finder's time grows with the pixels, while the
/// corners are refined in the full picture.
constexpr int kSearchWidth_px = 1600;

std::vector<BoardPoint> numbered(const Corners& corners) {
  std::vector<BoardPoint> points;
  for (std::size_t i = 0; i < corners.size(); ++i)
    points.push_back({int(i), {double(corners[i].x), double(corners[i].y)}});
  return points;
}

/// The smallest distance of neighbours in a row or column, px.
double smallest_gap_px(const Corners& corners, int columns) {
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto width = std::size_t(columns);
    if ((i + 1) % width != 0) gap = std::min(gap, cv::norm(corners[i + 1] - corners[i]));
    if (i + width < corners.size()) gap = std::min(gap, cv::norm(corners[i + width] - corners[i]));
  }
  return gap;
}

std::vector<BoardPoint> find_chessboard(const cv::Mat& gray, const Board& board) {
  const double scale = std::min(1.0, double(kSearchWidth_px) / gray.cols);
  cv::Mat searched = gray;
  if (scale < 1) cv::resize(gray, searched, {}, scale, scale, cv::INTER_AREA);
  Corners corners;
  const int flags =
      cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
  if (!cv::findChessboardCorners(searched, {board.columns, board.rows}, corners, flags)) return {};
  for (cv::Point2f& corner : corners) {
    corner.x = float((corner.x + 0.5) / scale - 0.5);
    corner.y = float((corner.y + 0.5) / scale - 0.5);
  }
  // The window must hold no other corner; 11 is that of OpenCV's samples.
  const int half = std::clamp(int(0.45 * smallest_gap_px(corners, board.columns)), 2, 11);
  cv::cornerSubPix(gray, corners, {half, half}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 60, 1e-3});
  return numbered(corners);
}

/// Dark blobs of every size that a board's circles may have in this picture.
cv::Ptr<cv::Feature2D> circle_finder(const cv::Mat& gray, const Board& board) {
  cv::SimpleBlobDetector::Params blobs;
  blobs.minArea = 16;
  blobs.maxArea = float(double(gray.total()) / (board.columns * board.rows));
  blobs.minDistBetweenBlobs = 4;
  return cv::SimpleBlobDetector::create(blobs);
}

std::vector<BoardPoint> find_circles(const cv::Mat& gray, const Board& board) {
  const bool asymmetric = board.pattern == Pattern::AsymmetricCircles;
  const int flags = asymmetric ? cv::CALIB_CB_ASYMMETRIC_GRID : cv::CALIB_CB_SYMMETRIC_GRID;
  Corners centres;
  // The finder's k-means draws from OpenCV's generator: seeded here, put back afterwards.
  const cv::RNG before = cv::theRNG();
  cv::theRNG() = cv::RNG(1);
  const bool found = cv::findCirclesGrid(gray, {board.columns, board.rows}, centres, flags,
                                         circle_finder(gray, board));
  cv::theRNG() = before;
  return found ? numbered(centres) : std::vector<BoardPoint>();
}

/// The smallest distance of any two corners, px.
double nearest_px(const Corners& corners) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      nearest = std::min(nearest, cv::norm(corners[i] - corners[j]));
  return nearest;
}

std::vector<BoardPoint> find_charuco(const cv::Mat& gray, const Board& board) {
  const auto dictionary = cv::aruco::getPredefinedDictionary(*marker_dictionary(board.dictionary));
  const auto charuco = cv::aruco::CharucoBoard::create(
      board.columns, board.rows, float(board.spacing_m), float(board.marker_m), dictionary);
  std::vector<Corners> markers;
  std::vector<int> ids;
  std::vector<Corners> rejected;
  cv::aruco::detectMarkers(gray, dictionary, markers, ids, cv::aruco::DetectorParameters::create(),
                           rejected);
  if (ids.empty()) return {};
  // A marker that was passed over is taken where the board expects it.
  cv::aruco::refineDetectedMarkers(gray, charuco, markers, ids, rejected);
  Corners corners;
  std::vector<int> corner_ids;
  cv::aruco::interpolateCornersCharuco(markers, ids, gray, charuco, corners, corner_ids);
  constexpr std::size_t kFewest = 6;
  if (corners.size() < kFewest || cv::aruco::testCharucoCornersCollinear(charuco, corner_ids))
    return {};
  // Refined once more in a window that holds no corner of a marker, which OpenCV's may.
  const double free = (1 - board.marker_m / board.spacing_m) / 2;
  const int half = std::clamp(int(0.8 * free * nearest_px(corners)), 2, 11);
  cv::cornerSubPix(gray, corners, {half, half}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 60, 1e-3});
  std::vector<BoardPoint> points = numbered(corners);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].id = corner_ids[i];
  return points;
}

/// The value below which this share of the values lies.
template <class T>
double percentile(std::vector<T>& values, double share) {
  const auto place = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return double(*place);
}

}  // namespace

std::vector<BoardPoint> find_board(const cv::Mat& gray, const Board& board) {
  board.check();
  if (gray.empty() || gray.type() != CV_8UC1)
    throw std::invalid_argument("a board is looked for in 8-bit grey pictures");
  switch (board.pattern) {
    case Pattern::Chessboard:
      return find_chessboard(gray, board);
    case Pattern::Circles:
    case Pattern::AsymmetricCircles:
      return find_circles(gray, board);
    case Pattern::Charuco:
      return find_charuco(gray, board);
  }
  return {};
}

double edge_width_px(const cv::Mat& gray, const std::vector<BoardPoint>& points) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<Pixel> seen;
  seen.reserve(points.size());
  for (const BoardPoint& point : points) seen.push_back(point.in_image);
  const PixelBox box = clipped(bounding_box(seen), gray.cols, gray.rows);
  if (box.width < 3 || box.height < 3) return kNone;
  const cv::Mat part = gray(cv::Rect(int(box.u), int(box.v), int(box.width), int(box.height)));
  std::vector<std::uint8_t> values;
  std::vector<float> slopes;
  for (int y = 1; y + 1 < part.rows; ++y) {
    for (int x = 1; x + 1 < part.cols; ++x) {
      const auto at = [&](int dx, int dy) { return float(part.at<std::uint8_t>(y + dy, x + dx)); };
      values.push_back(part.at<std::uint8_t>(y, x));
      slopes.push_back(std::hypot(at(1, 0) - at(-1, 0), at(0, 1) - at(0, -1)) / 2);
    }
  }
  const double range = percentile(values, 0.95) - percentile(values, 0.05);
  const double steepest = percentile(slopes, 0.99);
  return steepest > 0 ? range / steepest : kNone;
}

}  // namespace kestrel

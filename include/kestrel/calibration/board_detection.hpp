#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/calibration/board.hpp"

namespace kestrel {

/// The points of the board in an 8-bit grey picture, by OpenCV's finders, corners to a fraction of
/// a pixel; all of them, or of a ChArUco board those that are seen (six at least, not on a line).
/// Empty when the board is not found whole. Centres of circles are those of their images: with a
/// strong tilt or lens these are not the images of their centres (Heikkila 2000). The same picture
/// gives the same points. Throws std::invalid_argument for a picture that is empty or not 8-bit
/// grey, or a board that does not check.
std::vector<BoardPoint> find_board(const cv::Mat& gray, const Board& board);

/// How wide the sharpest edges inside a view of a board are, px: the range of grey (5 to 95 %) over
/// the steepest slope (99th percentile). About 2 for a sharp picture, more for a blurred one;
/// infinity for a picture without contrast or a view without points.
double edge_width_px(const cv::Mat& gray, const std::vector<BoardPoint>& points);

}  // namespace kestrel

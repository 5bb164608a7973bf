#pragma once

#include <opencv2/core/mat.hpp>

#include "kestrel/calibration/view_collector.hpp"

namespace kestrel {

/// What a guided capture shows to whoever holds the board: the picture (8-bit grey) with the cells
/// of the image that kept views cover tinted green, the board's points (green when the picture was
/// kept, else orange; the first row joined by a line), and two lines below: how many views are kept
/// and what to show next, and what came of this picture. 8-bit BGR, as wide as the picture and
/// kGuideLines_px higher; a field of grey for a picture that is empty or not 8-bit grey.
cv::Mat guide_picture(const cv::Mat& gray, const Offered& offered, const ViewCollector& views);

inline constexpr int kGuideLines_px = 48;

}  // namespace kestrel

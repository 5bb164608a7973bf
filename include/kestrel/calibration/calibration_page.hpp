#pragma once

#include <opencv2/core/mat.hpp>

#include "kestrel/calibration/calibration_job.hpp"
#include "kestrel/io/report.hpp"

namespace kestrel {

/// The page of a calibration: objections, numbers with their deviations, where the board was seen,
/// the residuals over the image and against zero, the errors of each view, ViSP's answer, and the
/// given picture (8-bit grey; empty: none) with the points found in `view`, before and after
/// undistortion.
Report calibration_report(const CalibrationResult& result, const cv::Mat& picture,
                          std::size_t view);

}  // namespace kestrel

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core/types.hpp>

#include "kestrel/eval/track_metrics.hpp"
#include "kestrel/geometry/homography.hpp"

#include "bench/stress_motion.hpp"

namespace kestrel::test {

/// Where a class shows its template.
struct StressView {
  std::string cls;
  cv::Size template_px;
  StressMotion motion;
};

/// Template px to frame px at an instant: K [r1 r2 t] of the poster's plane (Hartley & Zisserman
/// 2004, section 8.1).
Homography image_from_template(const StressView& view, double t_frames);

/// Instants at which the shutter of a frame sees: one, or so many that no corner moves more than
/// 0.7 px from one to the next. Frame 0 is never blurred.
std::vector<double> instants(const StressView& view, std::int64_t frame);

/// The template's corners, px: their mean over the instants.
Corners corners_seen(const StressView& view, std::int64_t frame);

/// Share of the template inside the image, 0 to 1.
double visible_share(const StressView& view, double t_frames);

}  // namespace kestrel::test

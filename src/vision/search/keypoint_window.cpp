#include "keypoint_window.hpp"

#include <algorithm>
#include <cmath>

#include "kestrel/vision/window.hpp"

#include "places.hpp"

namespace kestrel {
namespace {

/// Standard deviations of the prediction that the window for keypoints holds.
constexpr double kGate = 3;

/// A window of more than this share of the frame is left for the whole frame at once.
constexpr double kNearlyWhole = 0.6;

/// Where the motion leads, the whole frame once it is lost.
PixelBox kalman_window(const Frame& frame, const CornerMotion& motion) {
  const PixelBox box = gate(motion, kGate);
  const double by = std::max(box.width, box.height) / 4;  // what a keypoint reaches over
  const PixelBox wide{box.u - by, box.v - by, box.width + 2 * by, box.height + 2 * by};
  const PixelBox part = clipped(wide, frame.gray.cols, frame.gray.rows);
  return area_px2(part) > kNearlyWhole * area_px2(whole(frame)) ? whole(frame) : part;
}

}  // namespace

double area_px2(const PixelBox& box) { return box.width * box.height; }

PixelBox keypoint_window(const Frame& frame, const TrackState& state,
                         const std::optional<CornerMotion>& motion, const PixelBox& learned_at,
                         WindowPolicy policy) {
  if (policy == WindowPolicy::Doubling) return state.window;
  if (policy == WindowPolicy::Fixed) {
    const PixelBox first = first_window(learned_at, frame.gray.cols, frame.gray.rows);
    const Pixel at = centre(state.window);
    return {at.u - (first.width - 1) / 2, at.v - (first.height - 1) / 2, first.width, first.height};
  }
  if (!motion) return state.last_seen ? whole(frame) : state.window;
  return kalman_window(frame, *motion);
}

PixelBox strip(const Frame& frame, double most_px, std::int64_t turn) {
  const double width = frame.gray.cols;
  const double height = frame.gray.rows;
  const double part = std::max(std::floor(most_px / width), 32.0);
  if (part >= height) return whole(frame);
  const auto count = std::int64_t(std::ceil((height - part) / (part * 2 / 3))) + 1;
  const double top = std::floor((height - part) * double(turn % count) / double(count - 1));
  return {0, top, width, part};
}

}  // namespace kestrel

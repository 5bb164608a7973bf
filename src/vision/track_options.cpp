#include "kestrel/vision/track_options.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace kestrel {
namespace {

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

/// Checks a part under the name it has here: "part.option: ..." of its own.
template <typename Options>
void check_as(const std::string& part, const Options& options) {
  try {
    options.check();
  } catch (const std::invalid_argument& refused) {
    const std::string words = refused.what();
    throw std::invalid_argument(part + "." + words.substr(words.find('.') + 1));
  }
}

}  // namespace

void DetectOptions::check() const {
  check_as("detect.sift", sift);
  check_as("detect.match", match);
  check_as("detect.fit", fit);
  require(max_px_per_frame >= 64 * 64, "detect.max_px_per_frame: must be at least 4096");
}

void TrackOptions::check() const {
  sift.check();
  match.check();
  ransac.check();
  detect.check();
  blocks.check();
  align.check();
  motion.check();
  require(max_outline_deviation_px > 0 && std::isfinite(max_outline_deviation_px),
          "max_outline_deviation_px: must be above 0");
  require(coast_s >= 0 && std::isfinite(coast_s), "coast_s: must be at least 0");
  require(weak_share >= 0 && weak_share <= 1, "weak_share: must be 0 to 1");
  require(weak_frames >= 1, "weak_frames: must be at least 1");
  require(outline.min_area_ratio > 0 && outline.min_area_ratio < 1,
          "outline.min_area_ratio: must be between 0 and 1");
  require(outline.max_area_ratio > 1 && std::isfinite(outline.max_area_ratio),
          "outline.max_area_ratio: must be above 1");
  require(outline.min_side_px > 0 && std::isfinite(outline.min_side_px),
          "outline.min_side_px: must be above 0");
}

const char* name(TrackMethod method) {
  switch (method) {
    case TrackMethod::Paper:
      return "paper";
    case TrackMethod::Detect:
      return "detect";
    case TrackMethod::Hybrid:
      return "hybrid";
  }
  return "unknown";
}

const char* name(WindowPolicy policy) {
  switch (policy) {
    case WindowPolicy::Fixed:
      return "fixed";
    case WindowPolicy::Doubling:
      return "doubling";
    case WindowPolicy::Kalman:
      return "kalman";
  }
  return "unknown";
}

const char* name(SiftSource source) { return source == SiftSource::Kestrel ? "kestrel" : "opencv"; }

const char* name(Simd simd) { return simd == Simd::Auto ? "auto" : "baseline"; }

}  // namespace kestrel

#include "kestrel/vision/track_options.hpp"

#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

template <class Change>
std::string refusal(Change change) {
  TrackOptions options;
  change(options);
  try {
    options.check();
  } catch (const std::invalid_argument& refused) {
    const std::string words = refused.what();
    return words.substr(0, words.find(':'));
  }
  return "";
}

TEST(TrackOptions, DefaultsAreInRangeAndForFlight) {
  const TrackOptions options;
  options.check();
  EXPECT_EQ(options.method, TrackMethod::Hybrid);
}

TEST(TrackOptions, NamesTheFirstOptionOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal([](TrackOptions& o) { o.sift.sigma = -1; }), "sift.sigma");
  EXPECT_EQ(refusal([](TrackOptions& o) { o.match.ratio = 2; }), "match.ratio");
  EXPECT_EQ(refusal([](TrackOptions& o) { o.ransac.min_inliers = 3; }), "ransac.min_inliers");
  EXPECT_EQ(refusal([](TrackOptions& o) { o.outline.min_area_ratio = 0; }),
            "outline.min_area_ratio");
  EXPECT_EQ(refusal([](TrackOptions& o) { o.outline.max_area_ratio = 1; }),
            "outline.max_area_ratio");
  EXPECT_EQ(refusal([](TrackOptions& o) { o.outline.min_side_px = 0; }), "outline.min_side_px");
  EXPECT_EQ(refusal([](TrackOptions& o) { o.max_outline_deviation_px = 0; }),
            "max_outline_deviation_px");
  EXPECT_EQ(refusal([](TrackOptions& o) { o.detect.max_px_per_frame = 100; }),
            "detect.max_px_per_frame");
  EXPECT_EQ(refusal([](TrackOptions& o) { o.detect.sift.sigma = 0; }), "detect.sift.sigma");
  EXPECT_EQ(refusal([](TrackOptions& o) { o.detect.match.ratio = 2; }), "detect.match.ratio");
  EXPECT_EQ(refusal([](TrackOptions& o) { o.detect.fit.max_voters = 0; }), "detect.fit.max_voters");
  EXPECT_EQ(refusal([](TrackOptions& o) { o.blocks.max_blocks = 1; }), "blocks.max_blocks");
  EXPECT_EQ(refusal([](TrackOptions& o) { o.align.max_iterations = 0; }), "align.max_iterations");
  EXPECT_EQ(refusal([](TrackOptions& o) { o.motion.first_speed_px_s = 0; }),
            "motion.first_speed_px_s");
  EXPECT_EQ(refusal([&](TrackOptions& o) { o.coast_s = nan; }), "coast_s");
  EXPECT_EQ(refusal([](TrackOptions& o) { o.weak_share = 2; }), "weak_share");
  EXPECT_EQ(refusal([](TrackOptions& o) { o.weak_frames = 0; }), "weak_frames");
}

TEST(TrackOptions, HaveOneWordEach) {
  EXPECT_STREQ(name(TrackMethod::Paper), "paper");
  EXPECT_STREQ(name(TrackMethod::Detect), "detect");
  EXPECT_STREQ(name(TrackMethod::Hybrid), "hybrid");
  EXPECT_STREQ(name(WindowPolicy::Fixed), "fixed");
  EXPECT_STREQ(name(WindowPolicy::Doubling), "doubling");
  EXPECT_STREQ(name(WindowPolicy::Kalman), "kalman");
}

}  // namespace
}  // namespace kestrel

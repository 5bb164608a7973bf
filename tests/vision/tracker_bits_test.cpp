// The same answers, bit for bit, however the work is done: longer than the fast tests may be.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "kestrel/vision/tracker.hpp"

#include "support/planted_target.hpp"

namespace kestrel {
namespace {

using test::options_of;

/// A target that turns, nears and tilts in large steps.
Homography flight(int k) {
  const double a = 0.3 * k;
  return test::placed_at({200 + 50 * std::sin(a), 150 + 35 * std::sin(1.3 * a)},
                         {1 + 0.25 * std::sin(0.7 * a), 0.4 * std::sin(0.9 * a), 0.4, 1});
}

class TrackerBits : public testing::TestWithParam<TrackMethod> {};

INSTANTIATE_TEST_SUITE_P(Methods, TrackerBits,
                         testing::Values(TrackMethod::Paper, TrackMethod::Detect,
                                         TrackMethod::Hybrid),
                         [](const auto& method) { return std::string(name(method.param)); });

/// What a new tracker answers on a short flight with a loss.
std::vector<Track> flown(const TrackOptions& options) {
  Tracker tracker = test::tracker_of(options);
  TrackState state = tracker.start(test::kGroundWidth, test::kGroundHeight);
  std::vector<Track> all;
  for (int k = 0; k < 8; ++k) {
    const cv::Mat image = k == 4 || k == 5 ? test::ground() : test::planted(flight(k));
    all.push_back(tracker.track(test::frame_of(image, 0.04 * k), state));
    state = all.back().next;
  }
  return all;
}

bool same(const std::vector<Track>& a, const std::vector<Track>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Track& x, const Track& y) { return test::same(x, y); });
}

TEST_P(TrackerBits, AreTheSameWithAndWithoutAvx2) {
  TrackOptions plain = options_of(GetParam());
  plain.simd = Simd::Baseline;
  const auto fast = flown(options_of(GetParam()));
  EXPECT_TRUE(fast.back().found());
  EXPECT_TRUE(same(fast, flown(plain)));
}

TEST_P(TrackerBits, AreTheSameInThreadsOfTheirOwn) {
  const auto alone = flown(options_of(GetParam()));
  std::array<std::vector<Track>, 3> there;
  std::vector<std::thread> threads;
  for (auto& answers : there) {
    threads.emplace_back([&] { answers = flown(options_of(GetParam())); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& answers : there) EXPECT_TRUE(same(alone, answers));
}

TEST_P(TrackerBits, AreTheSameFromAUsedTrackerAndAFreshOne) {
  Tracker used = test::tracker_of(options_of(GetParam()));
  TrackState state = used.start(test::kGroundWidth, test::kGroundHeight);
  state = used.track(test::frame_of(test::planted(flight(0)), 0), state).next;
  for (const Homography& truth : {flight(1), test::placed_at({280, 190}, {0.8, 1, 0.3, 0})}) {
    Tracker fresh = test::tracker_of(options_of(GetParam()));
    const Frame frame = test::frame_of(test::planted(truth), 0.04);
    EXPECT_TRUE(test::same(used.track(frame, state), fresh.track(frame, state)));
    used.track(test::frame_of(test::ground(), 7), state);  // something else in between
    EXPECT_TRUE(test::same(used.track(frame, state), fresh.track(frame, state)));
  }
}

}  // namespace
}  // namespace kestrel

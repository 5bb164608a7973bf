// Nothing is allocated while the pixels are followed.
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "kestrel/vision/tracker.hpp"

#include "support/allocations.hpp"
#include "support/planted_target.hpp"

namespace kestrel {
namespace {

using test::allocations;

constexpr double kFrame_s = 0.04;

Homography flight(int k) {
  const double a = 0.08 * k;
  return test::placed_at({200 + 50 * std::sin(a), 150 + 35 * std::sin(1.3 * a)},
                         {1 + 0.2 * std::sin(0.7 * a), 0.4 * std::sin(0.9 * a), 0.4, 1});
}

/// How often memory was asked for from the warm-up on, and in how many frames the target was found.
struct Count {
  int allocations = 0;
  int found = 0;
};

Count counted(Tracker& tracker, const std::vector<cv::Mat>& images, std::size_t warm_up) {
  Count count;
  TrackState state = tracker.start(test::kGroundWidth, test::kGroundHeight);
  state.last_seen = flight(0);
  for (std::size_t k = 0; k < images.size(); ++k) {
    const Frame frame = test::frame_of(images[k], double(k) * kFrame_s);
    const int before = allocations;
    const Track seen = tracker.track(frame, state);
    if (k >= warm_up) count.allocations += allocations - before;
    count.found += seen.found() ? 1 : 0;
    state = seen.next;
  }
  return count;
}

TEST(Allocation, IsCounted) {
  const int before = allocations;
  const cv::Mat image(100, 100, CV_8UC1);
  EXPECT_GT(allocations, before);
  const int after = allocations;
  const std::vector<int> numbers(50, 1);
  EXPECT_GT(allocations, after) << numbers.size();
}

TEST(Allocation, ThereIsNoneWhileTheHybridFollowsThePixels) {
  std::vector<cv::Mat> images(55);
  for (int k = 0; k < 55; ++k) images[std::size_t(k)] = test::planted(flight(k));
  Tracker tracker = test::tracker_of({});
  const Count count = counted(tracker, images, 5);
  EXPECT_EQ(count.found, 55);
  EXPECT_EQ(count.allocations, 0);
}

TEST(Allocation, ThereIsNoneWhenTheNeighbourhoodIsSearched) {
  // Every fifth frame the target is a third of its width from where it should be.
  std::vector<cv::Mat> images;
  for (int k = 0; k < 30; ++k) {
    const double jump = k % 10 >= 5 ? 24 : 0;
    images.push_back(test::planted(test::placed_at({190 + jump, 150 + 0.5 * jump})));
  }
  Tracker tracker = test::tracker_of({});
  const Count count = counted(tracker, images, 10);
  EXPECT_EQ(count.found, 30);
  EXPECT_EQ(count.allocations, 0);
}

TEST(Allocation, ThereIsNoneForTheHomographyOfAnOutline) {
  const auto corners = outline(flight(7), 90, 70);
  const int before = allocations;
  const auto H = homography_from_outline(corners, 90, 70);
  EXPECT_EQ(allocations, before);
  EXPECT_TRUE(H);
}

}  // namespace
}  // namespace kestrel

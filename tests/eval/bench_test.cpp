#include "kestrel/eval/bench.hpp"

#include <gtest/gtest.h>

namespace kestrel {
namespace {

/// Says in how many frames it was asked.
BenchMethod counting() {
  return {"counting", [](const cv::Mat&, const PixelBox&) -> BenchTracker {
            return [asked = 0](const Frame&) mutable {
              BenchAnswer answer;
              answer.keypoints = ++asked;
              return answer;
            };
          }};
}

TEST(Bench, TrackersOfOneMethodShareNothing) {
  const BenchMethod method = counting();
  BenchTracker first = method.learn(cv::Mat(), PixelBox{});
  EXPECT_EQ(first(Frame{}).keypoints, 1);
  EXPECT_EQ(first(Frame{}).keypoints, 2);
  BenchTracker second = method.learn(cv::Mat(), PixelBox{});
  EXPECT_EQ(second(Frame{}).keypoints, 1);
  EXPECT_EQ(first(Frame{}).keypoints, 3);
}

TEST(Bench, AnAnswerThatSaysNothingIsNotFound) { EXPECT_FALSE(BenchAnswer{}.image_from_template); }

}  // namespace
}  // namespace kestrel

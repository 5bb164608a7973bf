#include "kestrel/vision/sift.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "support/random.hpp"
#include "support/sift_pictures.hpp"

namespace kestrel {
namespace {

using test::whole;

SiftPoints detect(const cv::Mat& gray, const FastSiftOptions& options = {}) {
  return FastSift(options).detect(gray, whole(gray));
}

bool same_bits(const SiftPoints& a, const SiftPoints& b) {
  return a.at.size() == b.at.size() && a.descriptors.size() == b.descriptors.size() &&
         std::memcmp(a.at.data(), b.at.data(), a.at.size() * sizeof(SiftPoint)) == 0 &&
         std::memcmp(a.descriptors.data(), b.descriptors.data(),
                     a.descriptors.size() * sizeof(Descriptor)) == 0;
}

/// A Gaussian blob of standard deviation s at (u, v), wider across than down by `stretch`.
cv::Mat blob(double u, double v, double s, double stretch = 1) {
  cv::Mat gray(96, 112, CV_8U);
  for (int y = 0; y < gray.rows; ++y) {
    for (int x = 0; x < gray.cols; ++x) {
      const double du = (x - u) / stretch;
      const double dv = y - v;
      gray.at<uchar>(y, x) =
          cv::saturate_cast<uchar>(40 + 180 * std::exp(-(du * du + dv * dv) / (2 * s * s)));
    }
  }
  return gray;
}

bool is_same(const SiftPoint& a, const SiftPoint& b) {
  return a.u == b.u && a.v == b.v && a.scale_px == b.scale_px && a.angle_rad == b.angle_rad;
}

/// The strongest keypoint.
SiftPoint strongest(const SiftPoints& points) {
  return *std::max_element(points.at.begin(), points.at.end(),
                           [](const auto& a, const auto& b) { return a.response < b.response; });
}

// The response to a Gaussian blob of deviation s, with t^2 = s^2 less the camera's assumed blur, is
// largest where the lower level's blur is t / 2^(1/6) for neighbouring levels a factor of 2^(1/3)
// apart. Steps of the parabola between levels bend that by some per cent.
TEST(FastSift, FindsABlobWhereItIsAndAsLargeAsItIs) {
  for (const bool is_doubled : {false, true}) {
    FastSiftOptions options;
    options.is_doubled = is_doubled;
    for (const double s : {2.5, 4.0, 6.3, 9.0}) {
      for (const auto& [u, v] : {std::pair(50.0, 48.0), {55.3, 46.7}, {51.5, 47.5}}) {
        const SiftPoints points = detect(blob(u, v, s), options);
        ASSERT_FALSE(points.at.empty()) << s;
        const SiftPoint found = strongest(points);
        // A parabola through pixels of the octave, up to s px apart, misses by some per cent of
        // that.
        const double near = std::max(0.05, 0.02 * s);
        EXPECT_NEAR(found.u, u, near) << s << is_doubled;
        EXPECT_NEAR(found.v, v, near) << s << is_doubled;
        EXPECT_NEAR(found.scale_px / (s / std::pow(2, 1. / 6)), 1, 0.06) << s << is_doubled;
      }
    }
  }
}

TEST(FastSift, GivesTheSameBitsWithAndWithoutAvx2) {
  const cv::Mat picture = test::sift_picture();
  for (const bool is_doubled : {false, true}) {
    for (const auto& [width, height] : {std::pair(320, 240), {131, 77}, {24, 40}}) {
      FastSiftOptions options;
      options.is_doubled = is_doubled;
      const cv::Mat part = picture(cv::Rect(0, 0, width, height));
      const SiftPoints fast = detect(part, options);
      options.simd = Simd::Baseline;
      EXPECT_TRUE(same_bits(fast, detect(part, options))) << width << " " << is_doubled;
      EXPECT_GT(fast.at.size(), 0U);
    }
  }
}

TEST(FastSift, DoesNotRememberWhatItSawBefore) {
  const cv::Mat picture = test::sift_picture();
  FastSift detector({});
  const SiftPoints first = detector.detect(picture, {40, 30, 150, 120});
  detector.detect(255 - picture, {3, 5, 300, 200});
  detector.detect(picture, {10, 10, 40, 170});
  EXPECT_TRUE(same_bits(first, detector.detect(picture, {40, 30, 150, 120})));
}

TEST(FastSift, SeesTheWindowOnlyAndAnswersInTheImage) {
  const cv::Mat picture = test::sift_picture();
  SiftPoints part = detect(picture(cv::Rect(41, 30, 150, 121)).clone());
  for (SiftPoint& p : part.at) {
    p.u += 41;
    p.v += 30;
  }
  EXPECT_TRUE(same_bits(part, FastSift({}).detect(picture, {41, 30, 150, 121})));
}

TEST(FastSift, CutsTheWindowToTheImage) {
  const cv::Mat picture = test::sift_picture();
  EXPECT_TRUE(same_bits(FastSift({}).detect(picture, {-50, -60, 200, 170}),
                        FastSift({}).detect(picture, {0, 0, 150, 110})));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const PixelBox& nowhere :
       {PixelBox{400, 0, 50, 50}, PixelBox{0, 0, 0, 0}, PixelBox{nan, 0, 50, 50}})
    EXPECT_TRUE(FastSift({}).detect(picture, nowhere).at.empty());
}

TEST(FastSift, BearsAnySize) {
  const cv::Mat picture = test::sift_picture();
  FastSift detector({});
  for (int width = 1; width < 40; width += 3) {
    for (int height = 1; height < 40; height += 2) {
      const SiftPoints& points = detector.detect(picture, {7, 9, double(width), double(height)});
      for (const SiftPoint& p : points.at) {
        EXPECT_TRUE(p.u >= 7 && p.v >= 9 && p.u <= 6 + width && p.v <= 8 + height);
      }
    }
  }
}

TEST(FastSift, FindsNothingWhereThereIsNothing) {
  for (const int level : {0, 128, 255})
    EXPECT_TRUE(detect(cv::Mat(60, 80, CV_8U, cv::Scalar(level))).at.empty());
  EXPECT_TRUE(FastSift({}).detect(cv::Mat(), {0, 0, 10, 10}).at.empty());
}

TEST(FastSift, RefusesWhatIsNotGrey) {
  EXPECT_THROW(detect(cv::Mat(60, 80, CV_8UC3, cv::Scalar::all(1))), std::invalid_argument);
  EXPECT_THROW(detect(cv::Mat(60, 80, CV_32F, cv::Scalar::all(1))), std::invalid_argument);
}

TEST(FastSift, KeepsTheStrongestInTheirOrder) {
  const cv::Mat picture = test::sift_picture();
  const SiftPoints all = detect(picture);
  ASSERT_GT(all.at.size(), 60U);
  FastSiftOptions options;
  options.max_keypoints = 50;
  const SiftPoints some = detect(picture, options);
  ASSERT_EQ(some.at.size(), 50U);
  std::vector<float> responses;
  for (const SiftPoint& p : all.at) responses.push_back(p.response);
  std::sort(responses.rbegin(), responses.rend());
  std::size_t next = 0;
  for (const SiftPoint& p : some.at) {
    EXPECT_GE(p.response, responses[49]);
    while (next < all.at.size() && !is_same(p, all.at[next])) ++next;
    EXPECT_LT(next, all.at.size()) << "not in the order of the whole";
  }
}

/// Of the keypoints both find, within a px, a fifth of the scale and 0.3 rad: how many of
/// cv::SIFT's have ours as the nearest of all of ours.
TEST(FastSift, DescribesAsOpencvDoes) {
  const cv::Mat picture = test::sift_picture()(cv::Rect(0, 0, 200, 150));
  FastSiftOptions options;
  options.is_doubled = true;
  options.max_keypoints = kMaxSiftPoints;
  const SiftPoints ours = detect(picture, options);
  const SiftPoints theirs = test::opencv_sift(picture);
  int common = 0;
  int alike = 0;
  for (std::size_t i = 0; i < theirs.at.size(); ++i) {
    const SiftPoint& p = theirs.at[i];
    const bool is_common = std::any_of(ours.at.begin(), ours.at.end(), [&p](const SiftPoint& q) {
      return test::distance(p, q) < 1 && std::abs(std::log(q.scale_px / p.scale_px)) < 0.2F &&
             std::abs(std::remainder(q.angle_rad - p.angle_rad, float(2 * M_PI))) < 0.3F;
    });
    if (!is_common) continue;
    ++common;
    const std::size_t j = test::nearest(theirs.descriptors[i], ours.descriptors);
    if (test::distance(p, ours.at[j]) < 1) ++alike;
  }
  // cv::SIFT describes from rounded pixels and keeps duplicates: the two do not find all the same.
  EXPECT_GT(common, 0.6 * double(theirs.at.size()));
  EXPECT_GT(alike, 0.97 * common);
}

TEST(FastSift, TurnsWithTheImage) {
  const cv::Mat picture = test::sift_picture();
  cv::Mat turned;
  cv::rotate(picture, turned, cv::ROTATE_90_CLOCKWISE);
  const SiftPoints upright = detect(picture);
  const SiftPoints after = detect(turned);
  int found = 0;
  for (std::size_t i = 0; i < upright.at.size(); ++i) {
    const SiftPoint& p = upright.at[i];
    const SiftPoint expected{float(picture.rows - 1) - p.v, p.u};
    for (std::size_t j = 0; j < after.at.size(); ++j) {
      const SiftPoint& q = after.at[j];
      const float turn = q.angle_rad - p.angle_rad - float(M_PI / 2);
      // The sides are even: which pixels the next octave is made of differs, and all that follows.
      if (test::distance(expected, q) > 0.1 ||
          std::abs(std::remainder(turn, float(2 * M_PI))) > 0.05F)
        continue;
      EXPECT_NEAR(q.scale_px / p.scale_px, 1, 0.06);
      if (test::squared_distance(upright.descriptors[i], after.descriptors[j]) < 40 * 40) ++found;
      break;
    }
  }
  EXPECT_GT(found, 0.85 * double(upright.at.size()));
}

TEST(FastSiftOptions, NamesWhatIsOutOfRange) {
  EXPECT_NO_THROW(FastSiftOptions().check());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto complaint = [](auto change) -> std::string {
    FastSiftOptions options;
    change(options);
    try {
      FastSift detector(options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  using testing::HasSubstr;
  EXPECT_THAT(complaint([](auto& o) { o.octave_layers = 0; }), HasSubstr("octave_layers"));
  EXPECT_THAT(complaint([](auto& o) { o.octave_layers = 6; }), HasSubstr("octave_layers"));
  EXPECT_THAT(complaint([](auto& o) { o.contrast_threshold = -1; }), HasSubstr("contrast"));
  EXPECT_THAT(complaint([&](auto& o) { o.contrast_threshold = nan; }), HasSubstr("contrast"));
  EXPECT_THAT(complaint([](auto& o) { o.edge_threshold = 0.5; }), HasSubstr("edge_threshold"));
  EXPECT_THAT(complaint([](auto& o) { o.sigma = 0.5; }), HasSubstr("sigma"));
  EXPECT_THAT(complaint([](auto& o) { o.max_keypoints = 0; }), HasSubstr("max_keypoints"));
  EXPECT_THAT(complaint([](auto& o) { o.max_keypoints = 9000; }), HasSubstr("max_keypoints"));
}

}  // namespace
}  // namespace kestrel

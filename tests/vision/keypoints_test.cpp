#include "kestrel/vision/keypoints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PixelBox whole(const cv::Mat& image) { return {0, 0, double(image.cols), double(image.rows)}; }

/// Sampled round bumps, symmetric about their centres, so that every bias of a detector shows.
cv::Mat bumps(const std::vector<Pixel>& centres, double sigma, int size) {
  cv::Mat image(size, size, CV_8U);
  for (int v = 0; v < size; ++v) {
    for (int u = 0; u < size; ++u) {
      double grey = 20;
      for (const Pixel& c : centres) {
        const double d = distance(c, {double(u), double(v)});
        grey += 220 * std::exp(-d * d / (2 * sigma * sigma));
      }
      image.at<uchar>(v, u) = cv::saturate_cast<uchar>(grey);
    }
  }
  return image;
}

const Pixel& nearest(const Keypoints& keypoints, const Pixel& to) {
  return *std::min_element(
      keypoints.at.begin(), keypoints.at.end(),
      [&](const Pixel& a, const Pixel& b) { return distance(a, to) < distance(b, to); });
}

/// Mean of found minus true position over bumps at random sub-pixel places.
Pixel bias_px(double sigma, const PixelBox& window) {
  test::Random random("bias");
  std::vector<Pixel> centres;
  centres.reserve(16);
  for (int i = 0; i < 16; ++i) {
    centres.push_back({30.0 + 40 * (i % 4) + random.uniform(-0.5, 0.5),
                       30.0 + 40 * (i / 4) + random.uniform(-0.5, 0.5)});  // NOLINT
  }
  const Keypoints found = detect_keypoints(bumps(centres, sigma, 180), window, {});
  Pixel mean;
  for (const Pixel& c : centres) {
    const Pixel& p = nearest(found, c);
    EXPECT_LT(distance(p, c), 0.3);
    mean = {mean.u + (p.u - c.u) / 16, mean.v + (p.v - c.v) / 16};
  }
  return mean;
}

TEST(Keypoints, LieOnCentresWithoutBias) {
  // cv::SIFT as it is stands 0.25 px off. 16 places average the interpolation error of each (up to
  // 0.1 px, both signs) to 0.03 px.
  for (const double sigma : {2.5, 5.0}) {
    for (const PixelBox& window : {PixelBox{0, 0, 180, 180}, PixelBox{3, 6, 175, 170}}) {
      const Pixel bias = bias_px(sigma, window);
      EXPECT_NEAR(bias.u, 0, 0.03) << sigma;
      EXPECT_NEAR(bias.v, 0, 0.03) << sigma;
    }
  }
}

TEST(Keypoints, DescribeTheCropAlone) {
  test::Random random("crop");
  const cv::Mat image = test::texture(200, 160, random);
  const PixelBox window{41, 23, 90, 70};
  const Keypoints in_window = detect_keypoints(image, window, {});
  const cv::Mat crop = image(cv::Rect(41, 23, 90, 70)).clone();
  const Keypoints in_crop = detect_keypoints(crop, whole(crop), {});
  ASSERT_GT(in_crop.at.size(), 10U);
  ASSERT_EQ(in_window.at.size(), in_crop.at.size());
  EXPECT_EQ(cv::norm(in_window.descriptors, in_crop.descriptors, cv::NORM_INF), 0);
  for (std::size_t i = 0; i < in_crop.at.size(); ++i) {
    EXPECT_NEAR(in_window.at[i].u, in_crop.at[i].u + 41, 1e-9);
    EXPECT_NEAR(in_window.at[i].v, in_crop.at[i].v + 23, 1e-9);
    EXPECT_GE(in_window.at[i].u, 41);
    EXPECT_LE(in_window.at[i].u, 41 + 89);
  }
}

TEST(Keypoints, HaveOneRowOf128FloatsEach) {
  test::Random random("rows");
  const cv::Mat image = test::texture(120, 100, random);
  const Keypoints found = detect_keypoints(image, whole(image), {});
  EXPECT_EQ(found.descriptors.rows, int(found.at.size()));
  EXPECT_EQ(found.descriptors.cols, 128);
  EXPECT_EQ(found.descriptors.type(), CV_32FC1);
}

TEST(Keypoints, AreNeverMoreThanTheBound) {
  test::Random random("bound");
  const cv::Mat image = test::texture(200, 160, random);
  const std::size_t all = detect_keypoints(image, whole(image), {}).at.size();
  for (const int bound : {1, 7, 30, 31, 32, 33}) {
    SiftOptions options;
    options.max_keypoints = bound;
    const Keypoints found = detect_keypoints(image, whole(image), options);
    EXPECT_EQ(found.at.size(), std::min(all, std::size_t(bound)));
    EXPECT_EQ(found.descriptors.rows, int(found.at.size()));
  }
}

TEST(Keypoints, AreTheSameBitsAtAnyThreadCount) {
  test::Random random("threads");
  const cv::Mat image = test::texture(260, 200, random);
  const int before = cv::getNumThreads();
  cv::setNumThreads(1);
  const Keypoints one = detect_keypoints(image, whole(image), {});
  cv::setNumThreads(2);
  for (int repeat = 0; repeat < 3; ++repeat) {
    const Keypoints several = detect_keypoints(image, whole(image), {});
    ASSERT_EQ(one.at.size(), several.at.size());
    EXPECT_EQ(cv::norm(one.descriptors, several.descriptors, cv::NORM_INF), 0);
    for (std::size_t i = 0; i < one.at.size(); ++i) {
      EXPECT_EQ(one.at[i].u, several.at[i].u);
      EXPECT_EQ(one.at[i].v, several.at[i].v);
    }
  }
  cv::setNumThreads(before);
}

TEST(Keypoints, AreNoneWhereThereIsNothingToSee) {
  test::Random random("nothing");
  const cv::Mat image = test::texture(100, 80, random);
  for (const PixelBox& window :
       {PixelBox{10, 10, 7, 50}, PixelBox{10, 10, 50, 7}, PixelBox{200, 10, 50, 50},
        PixelBox{-90, -90, 50, 50}, PixelBox{10, 10, -5, 20}, PixelBox{kNaN, 0, 50, 50},
        PixelBox{0, 0, std::numeric_limits<double>::infinity(), 50}, PixelBox{}}) {
    EXPECT_TRUE(detect_keypoints(image, window, {}).at.empty());
  }
  EXPECT_TRUE(detect_keypoints(cv::Mat(), {0, 0, 50, 50}, {}).at.empty());
  const cv::Mat flat(80, 100, CV_8U, cv::Scalar(90));
  EXPECT_TRUE(detect_keypoints(flat, whole(flat), {}).at.empty());
}

TEST(Keypoints, AreOfGreyImagesOnly) {
  const cv::Mat colour(80, 100, CV_8UC3, cv::Scalar::all(90));
  EXPECT_THROW(detect_keypoints(colour, whole(colour), {}), std::invalid_argument);
}

template <class T>
std::string complaint(T SiftOptions::*field, T value) {
  SiftOptions options;
  options.*field = value;
  try {
    options.check();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(SiftOptions, NamesWhatIsOutOfRange) {
  EXPECT_NO_THROW(SiftOptions().check());
  EXPECT_NE(complaint(&SiftOptions::octave_layers, 0).find("octave_layers"), std::string::npos);
  EXPECT_NE(complaint(&SiftOptions::contrast_threshold, -0.1).find("contrast_threshold"),
            std::string::npos);
  EXPECT_NE(complaint(&SiftOptions::contrast_threshold, kNaN).find("contrast_threshold"),
            std::string::npos);
  EXPECT_NE(complaint(&SiftOptions::edge_threshold, 0.5).find("edge_threshold"), std::string::npos);
  EXPECT_NE(complaint(&SiftOptions::sigma, 0.0).find("sigma"), std::string::npos);
  EXPECT_NE(complaint(&SiftOptions::max_keypoints, 0).find("max_keypoints"), std::string::npos);
}

}  // namespace
}  // namespace kestrel

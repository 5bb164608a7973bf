#include "kestrel/vision/align.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel {
namespace {

constexpr int kSide = 120;
constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr Pixel kMiddle{59.5, 59.5};
constexpr Pixel kThere{160, 120};

const cv::Mat& picture() {
  static const cv::Mat image = [] {
    test::Random random("align picture");
    return test::texture(kSide, kSide, random);
  }();
  return image;
}

/// Where a picture of this size is in the scene.
cv::Mat covered(const Homography& H, cv::Size size) {
  return test::view(cv::Mat(size, CV_8UC1, cv::Scalar(255)), H, kWidth, kHeight) > 250;
}

/// A ground with a texture of its own, the template laid over it.
cv::Mat scene(const Homography& H, double noise = 0) {
  test::Random random("align scene");
  cv::Mat image = test::texture(kWidth, kHeight, random);
  test::view(picture(), H, kWidth, kHeight).copyTo(image, covered(H, picture().size()));
  if (noise > 0) test::add_noise(image, noise, random);
  return image;
}

Aligner aligner(const AlignOptions& options = {}) {
  return {template_blocks(picture(), {}), options};
}

std::optional<Alignment> aligned(Aligner& with, const cv::Mat& image, const Homography& start) {
  ImagePyramid pyramid;
  pyramid.look(image, {0, 0, kWidth, kHeight}, with.levels(), Simd::Auto);
  return with.align(pyramid, start);
}

double error_px(const Alignment& a, const Homography& truth) {
  return test::corner_distance(a.image_from_template, truth, kSide, kSide);
}

Homography shifted(const Homography& H, double du, double dv) {
  return test::product(test::translation(du, dv), H);
}

TEST(Align, FindsTheViewFromNearby) {
  test::Random random("align views");
  Aligner with = aligner();
  for (int i = 0; i < 30; ++i) {
    const Homography H = test::moved({random.uniform(0.75, 1.3), random.uniform(-3, 3),
                                      random.uniform(0, 0.7), random.uniform(0, 6)},
                                     kMiddle, kThere);
    const auto found =
        aligned(with, scene(H, 2), shifted(H, random.uniform(-6, 6), random.uniform(-6, 6)));
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->is_accepted);
    // Bilinear rendering and sampling at changed scale blur by different amounts: a tenth of a px.
    EXPECT_LT(error_px(*found, H), 0.2) << i;
  }
}

TEST(Align, PullsInFromAQuarterOfTheTemplateAfterASearch) {
  const Homography H = test::moved({1, 0.1, 0.2, 0}, kMiddle, kThere);
  Aligner with = aligner();
  const cv::Mat image = scene(H, 2);
  ImagePyramid pyramid;
  pyramid.look(image, {0, 0, kWidth, kHeight}, with.levels(), Simd::Auto);
  for (int k = 0; k < 16; ++k) {
    const double a = k * M_PI / 8;
    const Homography start = shifted(H, 30 * std::cos(a), 30 * std::sin(a));
    const auto found = with.align(pyramid, with.search(pyramid, start));
    ASSERT_TRUE(found && found->is_accepted) << k;
    EXPECT_LT(error_px(*found, H), 0.2) << k;
  }
}

/// Lines of print: strokes 1 or 2 px wide and 3 px high, every 3 px.
cv::Mat fine_print(int width, int height) {
  test::Random random("fine print");
  cv::Mat page(height, width, CV_8UC1, cv::Scalar(220));
  for (int line = 2; line + 3 <= height; line += 5) {
    for (int u = 2; u + 2 < width; u += 3) {
      const int kind = random.integer(0, 5);
      if (kind > 0) page(cv::Rect(u, line, 1 + kind % 2, 3)).setTo(40);
    }
  }
  return page;
}

TEST(Align, PullsFinePrintIn) {
  // No coarser level, corners off by half a stroke's period: full steps lead away. Taken back and
  // shortened they find the place 35 times of 40, otherwise 25 times.
  const cv::Mat print = fine_print(60, 46);
  TemplateBlocks finest = template_blocks(print, {});
  finest.levels.resize(1);
  Aligner with(finest, {});
  const Homography H = test::moved({1.02, 0.02, 0.15, 1}, {29.5, 22.5}, kThere);
  cv::Mat image = scene(H);
  test::view(print, H, kWidth, kHeight).copyTo(image, covered(H, print.size()));
  test::Random random("starts off print");
  test::add_noise(image, 2, random);
  int pulled_in = 0;
  for (int k = 0; k < 40; ++k) {
    auto corners = outline(H, print.cols, print.rows);
    for (Pixel& corner : corners) {
      corner.u += 1.2 * random.normal();
      corner.v += 1.2 * random.normal();
    }
    const auto start = homography_from_outline(corners, print.cols, print.rows);
    const auto found = aligned(with, image, start.value());
    ASSERT_TRUE(found);
    const double off = test::corner_distance(found->image_from_template, H, print.cols, print.rows);
    pulled_in += off < 0.3 ? 1 : 0;
  }
  EXPECT_GE(pulled_in, 32);
}

TEST(Align, TakesTheStartWhereCoarseLevelsLeadAway) {
  // Broad light on a fine print, in the template and in the scene, where the light has moved by
  // 9 px and the print has not: coarse levels follow the light, the finest one knows better.
  test::Random random("light and print");
  cv::Mat print(kSide, kSide, CV_8UC1);
  for (int i = 0; i < int(print.total()); ++i) print.data[i] = uchar(random.integer(64, 192));
  cv::GaussianBlur(print, print, {}, 0.8);
  const cv::Mat light = test::texture(kSide, kSide, random);
  cv::Mat broad;
  cv::GaussianBlur(light, broad, {}, 6);
  const auto lit = [&](int by) {
    cv::Mat moved;
    cv::copyMakeBorder(broad, moved, 0, 0, by, 0, cv::BORDER_REFLECT);
    cv::Mat both;
    cv::addWeighted(print, 2, moved.colRange(0, kSide), 1, -256, both);
    return both;
  };
  Aligner with(template_blocks(lit(0), {}), {});
  const Homography H = test::translation(100, 60);
  cv::Mat image(kHeight, kWidth, CV_8UC1, cv::Scalar(128));
  lit(9).copyTo(image(cv::Rect(100, 60, kSide, kSide)));
  const auto found = aligned(with, image, H);
  ASSERT_TRUE(found);
  EXPECT_LT(error_px(*found, H), 0.5);
}

TEST(Align, DoesNotMindGainBiasAndShade) {
  const Homography H = test::moved({1, 0.2, 0.3, 1}, kMiddle, kThere);
  cv::Mat image = scene(H);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      uchar& p = image.at<uchar>(v, u);
      p = cv::saturate_cast<uchar>((0.4 + 0.3 * u / kWidth) * p + 40 - 0.1 * v);
    }
  }
  Aligner with = aligner();
  const auto found = aligned(with, image, shifted(H, 4, -3));
  ASSERT_TRUE(found && found->is_accepted);
  EXPECT_LT(error_px(*found, H), 0.2);
}

TEST(Align, SurvivesWhatCoversFortyPercent) {
  const Homography H = test::moved({1.1, -0.2, 0.2, 2}, kMiddle, kThere);
  cv::Mat image = scene(H, 2);
  test::Random random("cover");
  const cv::Mat cover = test::texture(kWidth, kHeight, random);
  const int left = int(kThere.u) - 70;
  cover(cv::Rect(left, 0, 56, kHeight)).copyTo(image(cv::Rect(left, 0, 56, kHeight)));
  Aligner with = aligner();
  const auto found = aligned(with, image, shifted(H, 3, 2));
  ASSERT_TRUE(found && found->is_accepted);
  EXPECT_LT(error_px(*found, H), 0.5);  // half the corners are covered: extrapolated
  EXPECT_LT(found->agreement.alike_share(), 0.8);
}

TEST(Align, WorksAtHalfAndTwiceTheSize) {
  Aligner with = aligner();
  for (const double scale : {0.5, 2.0}) {
    const Homography H = test::moved({scale, 0.3, 0, 0}, kMiddle, kThere);
    cv::Mat image;
    if (scale < 1) {  // rendered large, then halved twice: no aliasing
      const Homography twice = test::moved({2 * scale, 0.3, 0, 0}, kMiddle, {320.5, 240.5});
      const cv::Mat large = test::view(picture(), twice, 2 * kWidth, 2 * kHeight);
      cv::resize(large, image, {kWidth, kHeight}, 0, 0, cv::INTER_AREA);
    } else {
      image = test::view(picture(), H, kWidth, kHeight);
    }
    const auto found = aligned(with, image, shifted(H, 3, -2));
    ASSERT_TRUE(found && found->is_accepted) << scale;
    EXPECT_LT(error_px(*found, H), 0.3 * scale + 0.1) << scale;
  }
}

TEST(Align, RefusesWhatIsNotTheTemplate) {
  test::Random random("another texture");
  Aligner with = aligner();
  int accepted = 0;
  for (int i = 0; i < 40; ++i) {
    const cv::Mat other = test::texture(kWidth, kHeight, random);
    const Homography start =
        test::moved({random.uniform(0.6, 1.6), random.uniform(-3, 3), 0.3, 1}, kMiddle, kThere);
    const auto found = aligned(with, other, start);
    accepted += found && found->is_accepted ? 1 : 0;
  }
  EXPECT_EQ(accepted, 0);
}

TEST(Align, SeesNothingInAnEmptyPictureOrOutsideIt) {
  Aligner with = aligner();
  const Homography H = test::translation(100, 60);
  for (const double grey : {0.0, 128.0, 255.0}) {
    const auto found = aligned(with, cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(grey)), H);
    EXPECT_FALSE(found && found->is_accepted) << grey;
  }
  EXPECT_FALSE(aligned(with, scene(H), test::translation(5000, 0)));
  Homography nowhere;
  nowhere.H.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(aligned(with, scene(H), nowhere));
}

TEST(Align, CovarianceTellsHowFarTheCornersScatter) {
  // The same view under fresh noise: the corners' scatter is what the covariance claims, within a
  // factor of three: it allows for neighbours being alike, which independent noise is not.
  const Homography H = test::moved({1, 0.1, 0.2, 0}, kMiddle, kThere);
  const cv::Mat clean = scene(H);
  Aligner with = aligner();
  test::Random random("align noise");
  Eigen::Matrix<double, 8, 1> sum = Eigen::Matrix<double, 8, 1>::Zero();
  Eigen::Matrix<double, 8, 1> squares = sum;
  double claimed = 0;
  constexpr int kRuns = 60;
  for (int i = 0; i < kRuns; ++i) {
    cv::Mat image = clean.clone();
    test::add_noise(image, 12, random);
    const auto found = aligned(with, image, H);
    ASSERT_TRUE(found);
    const auto at = outline(found->image_from_template, kSide, kSide);
    Eigen::Matrix<double, 8, 1> x;
    for (Eigen::Index c = 0; c < 4; ++c)
      x.segment<2>(2 * c) << at[std::size_t(c)].u, at[std::size_t(c)].v;
    sum += x;
    squares += x.cwiseProduct(x);
    claimed += found->corner_covariance.trace() / 8 / kRuns;
  }
  const double scatter = ((squares - sum.cwiseProduct(sum) / kRuns) / (kRuns - 1)).mean();
  EXPECT_LT(std::sqrt(scatter), 1.5 * std::sqrt(claimed));
  EXPECT_GT(std::sqrt(scatter), std::sqrt(claimed) / 4);
}

TEST(Align, GivesTheSameBitsWithAndWithoutAvx2) {
  AlignOptions plain;
  plain.simd = Simd::Baseline;
  Aligner fast = aligner();
  Aligner slow = aligner(plain);
  const Homography H = test::moved({0.9, 0.4, 0.4, 1}, kMiddle, kThere);
  const cv::Mat image = scene(H, 3);
  const auto a = aligned(fast, image, shifted(H, 5, 4));
  const auto b = aligned(slow, image, shifted(H, 5, 4));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->image_from_template.H, b->image_from_template.H);
  EXPECT_EQ(a->corner_covariance, b->corner_covariance);
  EXPECT_EQ(a->iterations, b->iterations);
}

TEST(Align, RemembersNothing) {
  Aligner used = aligner();
  Aligner fresh = aligner();
  const Homography H = test::moved({1, 0.1, 0.2, 0}, kMiddle, kThere);
  aligned(used, scene(test::moved({1.4, 1, 0.2, 0}, kMiddle, kThere)), H);
  const auto a = aligned(used, scene(H), shifted(H, 3, 3));
  const auto b = aligned(fresh, scene(H), shifted(H, 3, 3));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->image_from_template.H, b->image_from_template.H);
}

TEST(Align, RefusesOptionsOutOfRange) {
  AlignOptions options;
  options.check();
  options.max_iterations = 0;
  EXPECT_THROW(aligner(options), std::invalid_argument);
  options = {};
  options.tolerance_px = 0;
  EXPECT_THROW(aligner(options), std::invalid_argument);
  options = {};
  options.weight_scale = -1;
  EXPECT_THROW(aligner(options), std::invalid_argument);
  options = {};
  options.search_radius_px = 100;
  EXPECT_THROW(aligner(options), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

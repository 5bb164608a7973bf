#include "kestrel/vision/template_blocks.hpp"

#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <opencv2/core.hpp>

#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel {
namespace {

constexpr int kWidth = 120;
constexpr int kHeight = 90;

const cv::Mat& picture() {
  static const cv::Mat image = [] {
    test::Random random("blocks picture");
    return test::texture(kWidth, kHeight, random);
  }();
  return image;
}

float texture(const BlockLevel& level, std::size_t block, int pixel) {
  return level.textures[block * 64 + std::size_t(pixel)];
}

float derivative(const BlockLevel& level, std::size_t block, int parameter, int pixel) {
  return level.derivatives[(block * 8 + std::size_t(parameter)) * 64 + std::size_t(pixel)];
}

TEST(TemplateBlocks, AreTheTemplatesPixelsLessTheirMean) {
  const TemplateBlocks all = template_blocks(picture(), {});
  const BlockLevel& level = all.levels.front();
  ASSERT_EQ(level.width, kWidth);
  ASSERT_EQ(level.height, kHeight);
  for (std::size_t b = 0; b < level.blocks.size(); ++b) {
    double mean = 0;
    double norm2 = 0;
    const TemplateBlock& block = level.blocks[b];
    const cv::Mat pixels = picture()(cv::Rect(int(block.u), int(block.v), 8, 8));
    const double expected = cv::mean(pixels)[0];
    for (int i = 0; i < 64; ++i) {
      EXPECT_NEAR(texture(level, b, i), pixels.at<uchar>(i / 8, i % 8) - expected, 1e-4);
      mean += double(texture(level, b, i)) / 64;
      norm2 += double(texture(level, b, i)) * texture(level, b, i);
    }
    EXPECT_NEAR(mean, 0, 1e-4);
    EXPECT_NEAR(norm2, block.texture_norm2, 1e-3 * norm2);
  }
}

TEST(TemplateBlocks, DerivativesAreThoseOfAWarpedLinearPicture) {
  // On a picture that is linear in u and v over each block, but for the bias and gain projected
  // out, the derivative is what central differences of warp() give.
  cv::Mat hill(64, 64, CV_8UC1);
  for (int v = 0; v < 64; ++v) {
    for (int u = 0; u < 64; ++u) {
      hill.at<uchar>(v, u) = cv::saturate_cast<uchar>(128 + 60 * std::sin(u * 0.21) +
                                                      50 * std::cos(v * 0.17 + u * 0.05));
    }
  }
  const auto shown = [](double u, double v) {
    return 128 + 60 * std::sin(u * 0.21) + 50 * std::cos(v * 0.17 + u * 0.05);
  };
  const TemplateBlocks all = template_blocks(hill, {});
  const BlockLevel& level = all.levels.front();
  const Eigen::Matrix3d scaled = scaled_from_template(64, 64);
  ASSERT_GE(level.blocks.size(), 20u);
  for (std::size_t b = 0; b < level.blocks.size(); b += 5) {
    for (int p = 0; p < 8; ++p) {
      Eigen::Matrix<double, 64, 1> slope;
      Eigen::Matrix<double, 64, 1> t;
      for (int i = 0; i < 64; ++i) {
        t[i] = double(texture(level, b, i));
        double difference = 0;
        for (const double h : {1e-5, -1e-5}) {
          Vector8d parameters = Vector8d::Zero();
          parameters[p] = h;
          const Eigen::Vector3d at =
              scaled.inverse() * warp(parameters) * scaled *
              Eigen::Vector3d(level.blocks[b].u + i % 8, level.blocks[b].v + i / 8, 1);
          difference += shown(at.x() / at.z(), at.y() / at.z()) / (2 * h);
        }
        slope[i] = difference;
      }
      slope.array() -= slope.mean();
      slope -= t * t.dot(slope) / t.squaredNorm();
      Eigen::Matrix<double, 64, 1> known;
      for (int i = 0; i < 64; ++i) known[i] = derivative(level, b, p, i);
      // The picture is rounded to whole greys and differenced over two pixels: some per cent.
      EXPECT_LT((known - slope).norm(), 0.1 * slope.norm() + 0.02 * t.norm() * 32)
          << "block " << b << " parameter " << p;
    }
  }
}

TEST(TemplateBlocks, DerivativesKnowNoGainAndNoBias) {
  const TemplateBlocks all = template_blocks(picture(), {});
  for (const BlockLevel& level : all.levels) {
    for (std::size_t b = 0; b < level.blocks.size(); ++b) {
      for (int p = 0; p < 8; ++p) {
        double bias = 0;
        double gain = 0;
        double size = 0;
        for (int i = 0; i < 64; ++i) {
          const double d = derivative(level, b, p, i);
          bias += d;
          gain += d * texture(level, b, i);
          size += d * d;
        }
        const double rounding = 1e-4 * std::sqrt(size * 64);
        EXPECT_NEAR(bias, 0, rounding);
        EXPECT_NEAR(gain, 0, rounding * std::sqrt(level.blocks[b].texture_norm2));
        EXPECT_NEAR(size, level.blocks[b].information(p, p), 1e-3 * size);
      }
    }
  }
}

TEST(TemplateBlocks, AreSpreadOverThePictureAndBounded) {
  BlockOptions options;
  options.max_blocks = 12;
  const TemplateBlocks all = template_blocks(picture(), options);
  std::set<std::pair<bool, bool>> quarters;
  for (const TemplateBlock& b : all.levels.front().blocks) {
    quarters.insert({b.u + 4 > kWidth / 2, b.v + 4 > kHeight / 2});
    EXPECT_GE(b.u, 0);
    EXPECT_LE(b.u + 8, kWidth);
    EXPECT_LE(b.v + 8, kHeight);
  }
  EXPECT_EQ(all.levels.front().blocks.size(), 12u);
  EXPECT_EQ(quarters.size(), 4u);
}

TEST(TemplateBlocks, ReachTheEdgesOfThePicture) {
  const TemplateBlocks all = template_blocks(picture(), {});
  std::set<double> columns;
  for (const TemplateBlock& b : all.levels.back().blocks) columns.insert(b.u);
  EXPECT_EQ(*columns.begin(), 0);
  EXPECT_EQ(*columns.rbegin() + 8, all.levels.back().width);
}

TEST(TemplateBlocks, LeaveOutWhatIsNoMoreThanNoise) {
  cv::Mat flat(60, 60, CV_8UC1, cv::Scalar(100));
  EXPECT_TRUE(template_blocks(flat, {}).levels.front().blocks.empty());
  test::Random random("sensor noise");
  test::add_noise(flat, 2, random);  // as much as the options take for noise
  EXPECT_TRUE(template_blocks(flat, {}).levels.front().blocks.empty());
  flat(cv::Rect(24, 24, 6, 6)).setTo(200);
  const TemplateBlocks spot = template_blocks(flat, {});
  ASSERT_FALSE(spot.levels.front().blocks.empty());
  for (const TemplateBlock& b : spot.levels.front().blocks) {
    EXPECT_TRUE(b.u < 31 && b.u + 8 > 23 && b.v < 31 && b.v + 8 > 23);
  }
}

TEST(TemplateBlocks, LeaveOutLevelsThatShowABeatOfTexturePixels) {
  // Stripes 2.3 px wide are seen at half the resolution as stripes of 15 px, which move by a third
  // of that when the pixels move by one.
  cv::Mat fine(80, 80, CV_8UC1);
  cv::Mat broad(80, 80, CV_8UC1);
  for (int v = 0; v < 80; ++v) {
    for (int u = 0; u < 80; ++u) {
      fine.at<uchar>(v, u) = uchar(std::lround(128 + 90 * std::sin(2 * M_PI * u / 2.3)));
      broad.at<uchar>(v, u) = uchar(std::lround(128 + 90 * std::sin(2 * M_PI * u / 11.5)));
    }
  }
  const TemplateBlocks beats = template_blocks(fine, {});
  EXPECT_FALSE(beats.levels[0].blocks.empty());
  EXPECT_TRUE(beats.levels[1].blocks.empty());
  EXPECT_FALSE(template_blocks(broad, {}).levels[1].blocks.empty());
  cv::rotate(fine, fine, cv::ROTATE_90_CLOCKWISE);
  EXPECT_TRUE(template_blocks(fine, {}).levels[1].blocks.empty());
}

TEST(TemplateBlocks, OfLessDetailHaveTheLevelsOfTheSharpPicture) {
  TemplateBlocks sharp = template_blocks(picture(), {});
  const TemplateBlocks same = template_blocks(picture(), {}, sharp);
  ASSERT_EQ(same.levels.size(), sharp.levels.size());
  EXPECT_EQ(same.levels[0].textures, sharp.levels[0].textures);
  for (const BlockLevel& level : same.levels) EXPECT_FALSE(level.blocks.empty());
  sharp.levels[1].blocks.clear();
  const TemplateBlocks without = template_blocks(picture(), {}, sharp);
  EXPECT_TRUE(without.levels[1].blocks.empty());
  EXPECT_TRUE(without.levels[1].textures.empty());
  EXPECT_EQ(without.levels[2].textures, same.levels[2].textures);
  EXPECT_THROW(template_blocks(picture().colRange(0, 100), {}, sharp), std::invalid_argument);
}

TEST(TemplateBlocks, WarpIsTheIdentityForZeroAndItsInverseToFirstOrder) {
  EXPECT_EQ(warp(Vector8d::Zero()), Eigen::Matrix3d::Identity());
  test::Random random("warp");
  Vector8d p;
  for (int k = 0; k < 8; ++k) p[k] = random.uniform(-1e-4, 1e-4);
  EXPECT_LT((warp(p) * warp(-p) - Eigen::Matrix3d::Identity()).norm(), 1e-6);
}

TEST(TemplateBlocks, ScaledCoordinatesReachOneAtTheLongerSide) {
  const Eigen::Matrix3d S = scaled_from_template(200, 100);
  EXPECT_NEAR((S * Eigen::Vector3d(-0.5, 49.5, 1)).x(), -1, 1e-12);  // the outer edge
  EXPECT_NEAR((S * Eigen::Vector3d(199.5, 49.5, 1)).x(), 1, 1e-12);
  EXPECT_NEAR((S * Eigen::Vector3d(99.5, 49.5, 1)).norm(), 1, 1e-12);  // the centre: (0, 0, 1)
}

TEST(TemplateBlocks, RefusesOptionsAndPicturesOutOfRange) {
  BlockOptions options;
  options.max_blocks = 3;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.max_coarse_blocks = 0;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.noise_grey = 0;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.model_error = 2;
  EXPECT_THROW(options.check(), std::invalid_argument);
  EXPECT_THROW(template_blocks(cv::Mat(), {}), std::invalid_argument);
  EXPECT_THROW(template_blocks(cv::Mat(7, 20, CV_8UC1), {}), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

#include "kestrel/io/raw_picture.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "kestrel/io/image_codec.hpp"

namespace kestrel {
namespace {

const cv::Size kSize(4, 3);

/// Bytes 0, 1, 2, ...: each tells where it stood.
std::vector<unsigned char> counting(std::size_t count) {
  std::vector<unsigned char> bytes(count);
  std::iota(bytes.begin(), bytes.end(), 0);
  return bytes;
}

TEST(GrayOf, TakesTheBrightnessOfEachLayout) {
  struct Case {
    RawFormat format;
    std::size_t bytes;
    int per_pixel;
    int offset;
  };
  for (const Case& c : {Case{RawFormat::Grey, 12, 1, 0}, Case{RawFormat::Nv12, 18, 1, 0},
                        Case{RawFormat::Yuv420, 18, 1, 0}, Case{RawFormat::Yuyv, 24, 2, 0},
                        Case{RawFormat::Uyvy, 24, 2, 1}}) {
    const auto bytes = counting(c.bytes);
    const cv::Mat gray = gray_of(c.format, {bytes.data(), bytes.size(), 0}, kSize);
    ASSERT_EQ(gray.size(), kSize) << name(c.format);
    for (int v = 0; v < kSize.height; ++v) {
      for (int u = 0; u < kSize.width; ++u)
        EXPECT_EQ(gray.at<uchar>(v, u), (v * kSize.width + u) * c.per_pixel + c.offset)
            << name(c.format);
    }
  }
}

TEST(GrayOf, WeighsColoursByTheirOrder) {
  const std::vector<unsigned char> red_first = {200, 10, 50, 200, 10, 50};
  const RawBytes bytes{red_first.data(), red_first.size(), 0};
  // Rec. 601: 0.299 R + 0.587 G + 0.114 B, rounded.
  EXPECT_EQ(gray_of(RawFormat::Rgb24, bytes, {2, 1}).at<uchar>(0, 1),
            std::lround(0.299 * 200 + 0.587 * 10 + 0.114 * 50));
  EXPECT_EQ(gray_of(RawFormat::Bgr24, bytes, {2, 1}).at<uchar>(0, 1),
            std::lround(0.299 * 50 + 0.587 * 10 + 0.114 * 200));
}

TEST(GrayOf, PassesOverTheGapBetweenRows) {
  const auto bytes = counting(3 * 6);
  const cv::Mat gray = gray_of(RawFormat::Grey, {bytes.data(), bytes.size(), 6}, kSize);
  EXPECT_EQ(gray.at<uchar>(2, 3), 15);
}

TEST(GrayOf, IsACopy) {
  auto bytes = counting(12);
  const cv::Mat gray = gray_of(RawFormat::Grey, {bytes.data(), bytes.size(), 0}, kSize);
  bytes.assign(12, 99);
  EXPECT_EQ(gray.at<uchar>(0, 1), 1);
}

TEST(GrayOf, ReadsJpegOfTheRightSizeOnly) {
  const auto jpeg = encode_jpeg(cv::Mat(16, 32, CV_8UC1, cv::Scalar(120)), 90);
  const RawBytes bytes{jpeg.data(), jpeg.size(), 0};
  EXPECT_NEAR(gray_of(RawFormat::Mjpeg, bytes, {32, 16}).at<uchar>(8, 8), 120, 2);  // flat JPEG
  EXPECT_TRUE(gray_of(RawFormat::Mjpeg, bytes, {16, 16}).empty());
  EXPECT_TRUE(gray_of(RawFormat::Mjpeg, {jpeg.data(), 40, 0}, {32, 16}).empty());
}

TEST(GrayOf, IsEmptyForWhatIsCutShort) {
  const auto bytes = counting(24);
  EXPECT_TRUE(gray_of(RawFormat::Grey, {bytes.data(), 11, 0}, kSize).empty());
  EXPECT_TRUE(gray_of(RawFormat::Yuyv, {bytes.data(), 23, 0}, kSize).empty());
  EXPECT_TRUE(gray_of(RawFormat::Grey, {bytes.data(), 24, 3}, kSize).empty());
  EXPECT_TRUE(gray_of(RawFormat::Grey, {nullptr, 24, 0}, kSize).empty());
  EXPECT_TRUE(gray_of(RawFormat::Grey, {bytes.data(), 24, 0}, {0, 0}).empty());
}

TEST(RawFormat, NamesReadBack) {
  for (const RawFormat format : raw_formats()) EXPECT_EQ(raw_format_named(name(format)), format);
  EXPECT_EQ(raw_formats().size(), 8u);
  EXPECT_FALSE(raw_format_named("h264"));
}

}  // namespace
}  // namespace kestrel

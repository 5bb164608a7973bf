#include "kestrel/io/image_codec.hpp"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "support/random.hpp"

namespace kestrel {
namespace {

using Bytes = std::vector<unsigned char>;

/// A smooth picture with noise: what JPEG is made for, and all bits of 16 in use.
cv::Mat picture(const std::string& name, int type) {
  test::Random random(name);
  cv::Mat small(5, 7, CV_MAKETYPE(CV_16U, CV_MAT_CN(type)));
  for (auto* at = small.ptr<ushort>(); at != small.ptr<ushort>() + small.total() * small.channels();
       ++at)
    *at = ushort(random.integer(0, 65535));
  cv::Mat image;
  cv::resize(small, image, {37, 29}, 0, 0, cv::INTER_LINEAR);
  if (CV_MAT_DEPTH(type) == CV_8U) image.convertTo(image, CV_8U, 1. / 257);
  return image;
}

Bytes file(const std::string& extension, const cv::Mat& image, const std::vector<int>& how = {}) {
  Bytes bytes;
  cv::imencode(extension, image, bytes, how);
  return bytes;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

/// OpenCV is the judge: every value, of every kind of file, ours or its own.
void expect_as_opencv(const Bytes& bytes, const std::string& what) {
  const cv::Mat expected = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  ASSERT_FALSE(expected.empty()) << what;
  EXPECT_TRUE(same(decode_image(bytes), expected)) << what;
}

TEST(DecodeImage, GivesWhatOpenCvGives) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3, CV_16UC4})
    expect_as_opencv(file(".png", picture("png", type)), "png " + std::to_string(type));
  for (const int type : {CV_8UC1, CV_8UC3}) {
    const cv::Mat image = picture("netpbm", type);
    for (const char* extension : {type == CV_8UC1 ? ".pgm" : ".ppm", ".bmp", ".tif"})
      expect_as_opencv(file(extension, image), extension + std::to_string(type));
    for (const int quality : {30, 95})
      expect_as_opencv(file(".jpg", image, {cv::IMWRITE_JPEG_QUALITY, quality}), "jpeg");
    expect_as_opencv(file(".jpg", image, {cv::IMWRITE_JPEG_PROGRESSIVE, 1}), "progressive");
  }
  expect_as_opencv(file(".png", picture("bits", CV_8UC1) > 128, {cv::IMWRITE_PNG_BILEVEL, 1}),
                   "png of one bit");
  expect_as_opencv(file(".pgm", picture("deep", CV_16UC1)), "pgm of 16 bits");
}

TEST(DecodeImage, ReadsTheHeaderOfAPgmAsWritten) {
  const std::string text = "P5 # a comment 3 4\n# 5 6\n 2\t1\n255\nab";
  const cv::Mat image = decode_image(Bytes(text.begin(), text.end()));
  ASSERT_EQ(image.size(), cv::Size(2, 1));
  EXPECT_EQ(image.at<uchar>(0, 0), 'a');
  EXPECT_EQ(image.at<uchar>(0, 1), 'b');
}

TEST(DecodeImage, IgnoresTheOrientationNote) {
  // Exif (JEITA CP-3451): a big-endian TIFF header, one entry, orientation 6: turn it clockwise.
  const Bytes note = {0xFF, 0xE1, 0, 34,   'E', 'x', 'i', 'f', 0, 0, 'M', 'M', 0, 42, 0, 0, 0, 8,
                      0,    1,    1, 0x12, 0,   3,   0,   0,   0, 1, 0,   6,   0, 0,  0, 0, 0, 0};
  Bytes bytes = file(".jpg", picture("exif", CV_8UC3));
  const cv::Mat plain = decode_image(bytes);
  bytes.insert(bytes.begin() + 2, note.begin(), note.end());
  ASSERT_EQ(cv::imdecode(bytes, cv::IMREAD_COLOR).size(), cv::Size(29, 37));  // the note is read
  EXPECT_TRUE(same(decode_image(bytes), plain));
}

TEST(DecodeImage, IsEmptyForWhatIsCutShort) {
  for (const char* extension : {".png", ".jpg", ".ppm"}) {
    const Bytes whole = file(extension, picture("cut", CV_8UC3));
    for (const double share : {0.02, 0.3, 0.9}) {
      Bytes part(whole.begin(), whole.begin() + std::ptrdiff_t(share * double(whole.size())));
      EXPECT_TRUE(decode_image(part).empty()) << extension << share;
    }
  }
}

TEST(DecodeImage, SurvivesAnyDamage) {
  test::Random random("damage");
  for (const char* extension : {".png", ".jpg", ".ppm"}) {
    const Bytes whole = file(extension, picture("damage", CV_8UC3));
    for (int trial = 0; trial < 200; ++trial) {
      Bytes bytes = whole;
      for (int i = 0; i < 4; ++i)
        bytes[std::size_t(random.integer(2, int(std::min<std::size_t>(bytes.size(), 400)) - 1))] =
            static_cast<unsigned char>(random.integer(0, 255));
      try {
        const cv::Mat image = decode_image(bytes);
        EXPECT_TRUE(image.empty() || image.rows > 0);
      } catch (const cv::Exception&) {  // memory for a size that a damaged head asks for
      }
    }
  }
}

TEST(EncodeJpeg, IsReadBackAsOpenCvWouldHaveWrittenIt) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    const cv::Mat image = picture("encode", type);
    const Bytes bytes = encode_jpeg(image, 85);
    EXPECT_TRUE(same(
        cv::imdecode(bytes, cv::IMREAD_UNCHANGED),
        cv::imdecode(file(".jpg", image, {cv::IMWRITE_JPEG_QUALITY, 85}), cv::IMREAD_UNCHANGED)));
  }
}

TEST(EncodeJpeg, RefusesWhatIsNoPicture) {
  EXPECT_THROW(encode_jpeg(cv::Mat(), 85), std::invalid_argument);
  EXPECT_THROW(encode_jpeg(cv::Mat(4, 4, CV_16UC1), 85), std::invalid_argument);
  EXPECT_THROW(encode_jpeg(cv::Mat(4, 4, CV_8UC1), 0), std::invalid_argument);
}

TEST(EncodePng, KeepsEveryPixel) {
  const cv::Mat grey = picture("encode png", CV_8UC1);
  EXPECT_TRUE(same(cv::imdecode(encode_png(grey), cv::IMREAD_UNCHANGED), grey));
  const cv::Mat part = grey(cv::Rect(3, 5, 20, 11));  // rows that do not touch
  EXPECT_TRUE(same(decode_image(encode_png(part)), part));
  EXPECT_THROW(encode_png(cv::Mat()), std::invalid_argument);
  EXPECT_THROW(encode_png(picture("colour", CV_8UC3)), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

#include "kestrel/io/gray_image.hpp"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using ::testing::HasSubstr;

cv::Mat random_image(const std::string& name, int type) {
  test::Random random(name);
  cv::Mat image(24, 32, type);
  for (auto* byte = image.data; byte != image.dataend; ++byte)
    *byte = uchar(random.integer(0, 255));
  return image;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

class GrayImage : public ::testing::Test {
 protected:
  std::filesystem::path save(const std::string& name, const cv::Mat& image) {
    const auto file = folder_.path() / name;
    cv::imwrite(file.string(), image);
    return file;
  }
  /// A copy of an image file with only this share of its bytes.
  std::filesystem::path cut(const std::string& name, double share) {
    std::ifstream in(folder_.path() / name, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    return folder_.write("cut_" + name, bytes.substr(0, std::size_t(double(bytes.size()) * share)));
  }
  test::TempFolder folder_;
};

TEST_F(GrayImage, KeepsGreyAsItIs) {
  const cv::Mat image = random_image("grey", CV_8UC1);
  EXPECT_TRUE(same(load_gray(save("a.pgm", image)), image));
  EXPECT_TRUE(same(load_gray(save("a.png", image)), image));
}

TEST_F(GrayImage, TurnsColourIntoLuma) {
  const cv::Mat image = random_image("colour", CV_8UC3);
  const cv::Mat gray = load_gray(save("a.png", image));
  for (int i = 0; i < 32; ++i) {
    const cv::Vec3b bgr = image.at<cv::Vec3b>(7, i);
    // ITU-R BT.601, in fixed point: half a grey level of rounding each.
    EXPECT_NEAR(gray.at<uchar>(7, i), 0.114 * bgr[0] + 0.587 * bgr[1] + 0.299 * bgr[2], 1);
  }
  cv::Mat with_alpha;
  cv::cvtColor(image, with_alpha, cv::COLOR_BGR2BGRA);
  EXPECT_TRUE(same(load_gray(save("b.png", with_alpha)), gray));
}

TEST_F(GrayImage, ScalesSixteenBitsToEight) {
  cv::Mat image(1, 4, CV_16UC1);
  const int values[] = {0, 257, 25700, 65535};
  for (int i = 0; i < 4; ++i) image.at<ushort>(0, i) = ushort(values[i]);
  const cv::Mat gray = load_gray(save("a.png", image));
  ASSERT_EQ(gray.type(), CV_8UC1);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(gray.at<uchar>(0, i), values[i] / 257);
}

TEST_F(GrayImage, RefusesWhatIsNoWholeImage) {
  const cv::Mat image = random_image("cut", CV_8UC1);
  save("a.png", image);
  save("a.jpg", image);
  save("a.pgm", image);
  for (const char* name : {"a.png", "a.jpg", "a.pgm"}) {
    EXPECT_THROW(load_gray(cut(name, 0.6)), FileError) << name;
    EXPECT_THROW(load_gray(cut(name, 0)), FileError) << name;
  }
  EXPECT_THROW(load_gray(folder_.write("junk.png", "no image at all")), FileError);
  EXPECT_THAT(message_of([&] { load_gray(folder_.path() / "none.png"); }),
              HasSubstr("none.png: there is no such file"));
  EXPECT_THAT(message_of([&] { load_gray(folder_.path()); }), HasSubstr("is a folder"));
}

TEST(AsGray, IsEmptyForWhatIsNoImage) {
  EXPECT_TRUE(as_gray(cv::Mat()).empty());
  EXPECT_TRUE(as_gray(cv::Mat(4, 4, CV_32FC1)).empty());
  EXPECT_TRUE(as_gray(cv::Mat(4, 4, CV_8UC2)).empty());
}

TEST(AsGray, CopiesSoThatTheSourceMayBeReused) {
  cv::Mat image(4, 4, CV_8UC1, cv::Scalar(7));
  const cv::Mat gray = as_gray(image);
  image.setTo(9);
  EXPECT_EQ(gray.at<uchar>(0, 0), 7);
}

TEST(SavePng, IsReadBackToTheLastBit) {
  const test::TempFolder folder;
  cv::Mat picture(7, 5, CV_8UC1);
  test::Random random("save png");
  for (int i = 0; i < 35; ++i) picture.data[i] = std::uint8_t(random.integer(0, 255));
  save_png(folder / "p.png", picture);
  EXPECT_EQ(cv::norm(load_gray(folder / "p.png"), picture, cv::NORM_INF), 0);
}

TEST(SavePng, SaysWhenTheDiskIsFullAndTouchesNoDevice) {
  const test::TempFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "p.png");
  EXPECT_THAT(test::message_of([&] { save_png(folder / "p.png", cv::Mat(40, 40, CV_8UC1, 7)); }),
              HasSubstr("No space left"));
  EXPECT_TRUE(std::filesystem::exists("/dev/full"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "p.png"));
}

}  // namespace
}  // namespace kestrel

#include "kestrel/io/video_reader.hpp"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "kestrel/io/gray_image.hpp"
#include "kestrel/io/video_writer.hpp"

#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using ::testing::HasSubstr;

constexpr int kPictures = 12;

/// Colours that move, so that every picture is another one.
cv::Mat picture(const cv::Size& size, int number) {
  test::Random random("video");
  cv::Mat small(6, 8, CV_8UC3);
  for (auto* byte = small.data; byte != small.dataend; ++byte)
    *byte = uchar(random.integer(0, 255));
  cv::Mat image;
  cv::resize(small, image, size + cv::Size(kPictures, 0), 0, 0, cv::INTER_CUBIC);
  return image(cv::Rect(cv::Point(number, 0), size)).clone();
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

class VideoReaderTest : public ::testing::Test {
 protected:
  /// H.264 keeps a cropped picture when the size is no multiple of 16.
  std::filesystem::path mp4(const std::string& name, const cv::Size& size) {
    VideoWriter writer(folder_ / name, 25);
    for (int i = 0; i < kPictures; ++i) writer.write(picture(size, i));
    writer.close();
    return writer.path();
  }
  std::filesystem::path avi(const std::string& name, const cv::Size& size) {
    cv::VideoWriter writer((folder_ / name).string(), cv::CAP_OPENCV_MJPEG,
                           cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10, size);
    for (int i = 0; i < kPictures; ++i) writer.write(picture(size, i));
    writer.release();
    return folder_ / name;
  }
  /// Asks for a clockwise quarter turn: the matrix in the box tkhd of an MP4 file (ISO/IEC
  /// 14496-12, 8.3.2), 44 bytes behind the box's name.
  std::filesystem::path turn(const std::filesystem::path& file, int width) {
    std::string bytes = bytes_of(file);
    const std::size_t at = bytes.find("tkhd") + 44;
    const std::uint32_t matrix[] = {0, 0x10000,   0, 0xFFFF0000, 0, 0, std::uint32_t(width) << 16,
                                    0, 0x40000000};
    for (std::size_t i = 0; i < 36; ++i) bytes[at + i] = char(matrix[i / 4] >> (24 - 8 * (i % 4)));
    return folder_.write("turned.mp4", bytes);
  }
  test::TempFolder folder_;
};

TEST_F(VideoReaderTest, GivesTheGreyValuesOfOpenCv) {
  for (const auto& file : {mp4("a.mp4", {96, 64}), mp4("b.mp4", {90, 70}), mp4("c.mp4", {81, 61}),
                           avi("d.avi", {90, 70}), avi("e.avi", {81, 61})}) {
    cv::VideoCapture judge(file.string(), cv::CAP_FFMPEG);
    VideoReader reader(file);
    EXPECT_EQ(reader.promised(), kPictures) << file;
    EXPECT_EQ(reader.rate_hz(), judge.get(cv::CAP_PROP_FPS)) << file;
    cv::Mat bgr;
    int pictures = 0;
    for (; judge.read(bgr); ++pictures) {
      const auto mine = reader.next();
      ASSERT_TRUE(mine) << file << pictures;
      ASSERT_EQ(mine->gray.size(), bgr.size()) << file;
      EXPECT_EQ(cv::norm(mine->gray, as_gray(bgr), cv::NORM_INF), 0) << file << pictures;
      // Times are counted in ticks of the file, of which a whole number lies between pictures.
      EXPECT_DOUBLE_EQ(mine->time_s.value_or(-1), pictures / *reader.rate_hz()) << file;
    }
    EXPECT_EQ(pictures, kPictures) << file;
    EXPECT_FALSE(reader.next()) << file;
    EXPECT_EQ(reader.damaged(), 0) << file;
  }
}

TEST_F(VideoReaderTest, SkipsAPictureButCountsItsTime) {
  const auto file = mp4("a.mp4", {96, 64});
  VideoReader all(file);
  VideoReader some(file);
  for (int i = 0; i < 5; ++i) all.next();
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(some.skip());
  const auto a = all.next();
  const auto b = some.next();
  EXPECT_EQ(cv::norm(a->gray, b->gray, cv::NORM_INF), 0);
  EXPECT_EQ(b->time_s, 5. / 25);
  for (int i = 6; i < kPictures; ++i) EXPECT_TRUE(some.skip());
  EXPECT_FALSE(some.skip());
}

TEST_F(VideoReaderTest, TurnsThePictureUpright) {
  const auto file = mp4("a.mp4", {96, 64});
  const auto plain = VideoReader(file).next();
  const auto turned = VideoReader(turn(file, 64)).next();
  cv::Mat clockwise;
  cv::rotate(plain->gray, clockwise, cv::ROTATE_90_CLOCKWISE);
  ASSERT_EQ(turned->gray.size(), clockwise.size());
  EXPECT_EQ(cv::norm(turned->gray, clockwise, cv::NORM_INF), 0);
}

TEST_F(VideoReaderTest, PassesOverADamagedPicture) {
  std::string bytes = bytes_of(avi("a.avi", {90, 70}));
  // The fifth frame's chunk (RIFF: 00dc and a size of four bytes, then a JPEG) made no JPEG.
  std::size_t at = bytes.find("movi");
  for (int i = 0; i < 5; ++i) at = bytes.find("00dc", at + 4);
  std::fill_n(bytes.begin() + std::ptrdiff_t(at) + 8, 600, '\0');
  VideoReader reader(folder_.write("b.avi", bytes));
  int pictures = 0;
  while (reader.next()) ++pictures;
  EXPECT_EQ(pictures, kPictures - 1);
  EXPECT_EQ(reader.damaged(), 1);
}

TEST_F(VideoReaderTest, RefusesWhatIsNoVideo) {
  const auto junk = folder_.write("junk.mp4", "no video");
  EXPECT_THAT(message_of([&] { VideoReader reader(junk); }),
              HasSubstr("junk.mp4: is no video that FFmpeg can read; re-encode it"));
  // Without its index, which stands at the end, an MP4 file cannot be read.
  const std::string whole = bytes_of(mp4("a.mp4", {96, 64}));
  const auto cut = folder_.write("cut.mp4", whole.substr(0, whole.size() / 2));
  EXPECT_THROW(VideoReader reader(cut), std::runtime_error);
}

TEST_F(VideoReaderTest, EndsWhereACutFileEnds) {
  const std::string whole = bytes_of(avi("a.avi", {90, 70}));
  VideoReader reader(folder_.write("cut.avi", whole.substr(0, whole.size() / 2)));
  int pictures = 0;
  while (reader.next()) ++pictures;
  EXPECT_GT(pictures, 2);
  EXPECT_LT(pictures, kPictures);
  EXPECT_EQ(reader.promised(), kPictures);
}

}  // namespace
}  // namespace kestrel

#include "kestrel/io/video_writer.hpp"

#include <csignal>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::vector<cv::Mat> frames_of(const std::filesystem::path& path) {
  cv::VideoCapture video(path.string());
  std::vector<cv::Mat> out;
  for (cv::Mat frame; video.read(frame);) out.push_back(frame.clone());
  return out;
}

std::string opening_error(const std::filesystem::path& path) {
  try {
    VideoWriter writer(path, 25);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(VideoWriter, IsReadBack) {
  const test::TempFolder folder;
  VideoWriter video(folder / "a.mp4", 25);
  for (int i = 0; i < 12; ++i)
    video.write(cv::Mat(60, 81, CV_8UC3, cv::Scalar::all(20 * i)));  // an odd width
  video.write(cv::Mat());
  video.close();
  video.close();
  EXPECT_EQ(video.frames(), 12);
  const auto frames = frames_of(video.path());
  ASSERT_EQ(frames.size(), 12u);
  EXPECT_EQ(frames[0].size(), cv::Size(82, 60));
  // H.264 keeps a flat field within a few grey levels; the codec's range conversion adds one.
  for (int i = 0; i < 12; ++i)
    EXPECT_NEAR(cv::mean(frames[std::size_t(i)].colRange(0, 70))[1], 20 * i, 6);
}

TEST(VideoWriter, PutsOtherSizesBetweenBars) {
  const test::TempFolder folder;
  VideoWriter video(folder / "a.mp4", 25);
  const cv::Mat wide(60, 120, CV_8UC3, cv::Scalar::all(200));
  const cv::Mat square(240, 240, CV_8UC1, cv::Scalar(200));
  for (int i = 0; i < 3; ++i) video.write(wide);
  for (int i = 0; i < 3; ++i) video.write(square);
  video.close();
  const auto frames = frames_of(video.path());
  ASSERT_EQ(frames.size(), 6u);
  const cv::Mat last = frames.back();
  EXPECT_EQ(last.size(), wide.size());
  EXPECT_LT(cv::mean(last.colRange(0, 26))[0], 20);  // 30 columns of bar, 4 of blur
  EXPECT_GT(cv::mean(last.colRange(34, 86))[0], 180);
  EXPECT_LT(cv::mean(last.colRange(94, 120))[0], 20);
}

TEST(VideoWriter, ClosesWhenItDies) {
  const test::TempFolder folder;
  { VideoWriter(folder / "a.mp4", 25).write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(9))); }
  EXPECT_EQ(frames_of(folder / "a.mp4").size(), 1u);
}

TEST(VideoWriter, WithoutFramesLeavesNoFile) {
  const test::TempFolder folder;
  VideoWriter video(folder / "a.mp4", 25);
  video.close();
  EXPECT_FALSE(std::filesystem::exists(folder / "a.mp4"));
}

TEST(VideoWriter, TellsWhatIsWrongWithThePath) {
  const test::TempFolder folder;
  EXPECT_THAT(opening_error(folder / "missing/a.mp4"),
              AllOf(HasSubstr("missing/a.mp4"), HasSubstr("create its folder")));
  EXPECT_THAT(opening_error("/dev/full"), HasSubstr("No space left"));
  EXPECT_TRUE(std::filesystem::exists("/dev/full"));
  EXPECT_THROW(VideoWriter(folder / "a.mp4", 0), std::invalid_argument);
}

TEST(VideoWriter, SaysThatTheFileIsNotWhole) {
  const test::TempFolder folder;
  VideoWriter video(folder / "a.mp4", 25);
  video.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(9)));
  std::filesystem::remove(folder / "a.mp4");
  EXPECT_THROW(video.close(), std::runtime_error);
}

/// No file may grow beyond this while it lives.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : before_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &limit_);
    const rlimit small{bytes, limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &limit_);
    std::signal(SIGXFSZ, before_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit limit_{};
  void (*before_)(int);
};

TEST(VideoWriter, AFullDiskIsToldAtTheEnd) {
  const test::TempFolder folder;
  VideoWriter video(folder / "a.mp4", 25);
  const SmallDisk disk(20000);
  test::Random random("noise");
  cv::Mat noise(120, 160, CV_8UC1);
  for (int i = 0; i < 12; ++i) {
    for (auto* byte = noise.data; byte != noise.dataend; ++byte)
      *byte = uchar(random.integer(0, 255));
    EXPECT_NO_THROW(video.write(noise));  // a flight goes on
  }
  EXPECT_THROW(video.close(), std::runtime_error);
}

TEST(VideoWriter, WritesMotionJpegWhereItIsAskedFor) {
  const test::TempFolder folder;
  VideoWriter video(folder / "a.avi", 25);
  for (int i = 0; i < 5; ++i) video.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(40 * i)));
  video.close();
  EXPECT_EQ(video.path(), folder / "a.avi");
  cv::VideoCapture file(video.path().string());
  EXPECT_EQ(int(file.get(cv::CAP_PROP_FOURCC)), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'));
  const auto frames = frames_of(video.path());
  ASSERT_EQ(frames.size(), 5u);
  // A flat JPEG is off by its quantisation, a few grey levels.
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(cv::mean(frames[std::size_t(i)])[1], 40 * i, 3);
}

TEST(VideoWriter, IsSilent) {
  const test::TempFolder folder;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  {
    VideoWriter video(folder / "a.mp4", 25);
    for (int i = 0; i < 3; ++i) video.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(9)));
  }
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace kestrel

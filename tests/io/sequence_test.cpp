#include "kestrel/io/sequence.hpp"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "kestrel/io/video_writer.hpp"

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// An image that says its number in its grey value.
cv::Mat picture(int number) { return cv::Mat(48, 64, CV_8UC1, cv::Scalar(10 * number)); }

std::vector<Frame> all_frames(FrameSource& source) {
  std::vector<Frame> frames;
  while (auto frame = source.next()) frames.push_back(*frame);
  return frames;
}

std::vector<std::int64_t> indices(const std::vector<Frame>& frames) {
  std::vector<std::int64_t> list;
  for (const Frame& frame : frames) list.push_back(frame.index);
  return list;
}

class Sequence : public ::testing::Test {
 protected:
  /// Writes images i0003.pgm ... i0009.pgm.
  Sequence() {
    for (int number = 3; number <= 9; ++number) {
      cv::imwrite(file(number).string(), picture(number));
    }
    options_.input = (folder_.path() / "i%04d.pgm").string();
    options_.rate_hz = 20;
  }
  std::filesystem::path file(int number) const {
    return folder_.path() / ("i000" + std::to_string(number) + ".pgm");
  }
  std::string error() {
    return message_of([&] { open_sequence(options_); });
  }
  test::TempFolder folder_;
  SequenceOptions options_;
};

TEST_F(Sequence, TakesAListOfFilesInItsOrder) {
  options_.input = "two of them";
  options_.files = {file(8), file(4), folder_.path() / "gone.pgm", file(5)};
  const auto source = open_sequence(options_);
  const auto frames = all_frames(*source);
  EXPECT_THAT(indices(frames), ElementsAre(0, 1, 3));
  EXPECT_EQ(frames[0].gray.at<uchar>(0, 0), 80);
  EXPECT_EQ(frames[1].gray.at<uchar>(0, 0), 40);
  EXPECT_THAT(source->skipped(), ElementsAre(HasSubstr("gone.pgm")));
  options_.files = {folder_.path() / "gone.pgm"};
  options_.package = "such-a-package";
  EXPECT_THAT(error(), AllOf(HasSubstr("two of them"), HasSubstr("such-a-package")));
}

TEST_F(Sequence, CountsAndStampsFromItsFrameZero) {
  const auto source = open_sequence(options_);
  EXPECT_EQ(source->frame_count(), 7);
  const auto frames = all_frames(*source);
  EXPECT_THAT(indices(frames), ElementsAre(0, 1, 2, 3, 4, 5, 6));
  for (const Frame& frame : frames) {
    EXPECT_EQ(frame.stamp_s, double(frame.index) / 20);
    EXPECT_EQ(frame.gray.at<uchar>(0, 0), 10 * (frame.index + 3));
  }
  EXPECT_TRUE(source->skipped().empty());
  EXPECT_FALSE(source->next().has_value());
}

TEST_F(Sequence, KeepsTheCountWhateverPartIsRead) {
  options_.first_frame = 2;
  options_.last_frame = 4;
  const auto source = open_sequence(options_);
  EXPECT_EQ(source->frame_count(), 3);
  const auto frames = all_frames(*source);
  EXPECT_THAT(indices(frames), ElementsAre(2, 3, 4));
  EXPECT_EQ(frames[0].gray.at<uchar>(0, 0), 50);
  options_.first_number = 4;
  EXPECT_EQ(open_sequence(options_)->next()->gray.at<uchar>(0, 0), 60);
}

TEST_F(Sequence, PassesOverDamagedAndMissingFramesAndNamesThem) {
  folder_.write("i0005.pgm", "P5\n64 48\n255\nonly a few bytes");
  std::filesystem::remove(file(7));
  const auto source = open_sequence(options_);
  EXPECT_THAT(indices(all_frames(*source)), ElementsAre(0, 1, 3, 5, 6));
  ASSERT_EQ(source->skipped().size(), 2u);
  EXPECT_THAT(source->skipped()[0], AllOf(HasSubstr("frame 2: "), HasSubstr("i0005.pgm")));
  EXPECT_EQ(source->skipped()[1], "frame 4: there is no such file");
}

TEST_F(Sequence, PassesOnAFrameOfAnotherSize) {
  cv::imwrite(file(4).string(), cv::Mat(10, 20, CV_8UC1, cv::Scalar(1)));
  const auto frames = all_frames(*open_sequence(options_));
  EXPECT_EQ(frames[0].gray.size(), cv::Size(64, 48));
  EXPECT_EQ(frames[1].gray.size(), cv::Size(20, 10));
}

TEST_F(Sequence, ReadsAFolderInNaturalOrder) {
  const test::TempFolder folder;
  cv::imwrite((folder.path() / "f10.png").string(), picture(2));
  cv::imwrite((folder.path() / "f9.png").string(), picture(1));
  options_.input = folder.path().string();
  const auto frames = all_frames(*open_sequence(options_));
  EXPECT_THAT(indices(frames), ElementsAre(0, 1));
  EXPECT_EQ(frames[0].gray.at<uchar>(0, 0), 10);
}

TEST_F(Sequence, SaysWhatToDoWhenThereIsNothing) {
  options_.package = "visp-images-data";
  options_.input = (folder_.path() / "none%d.png").string();
  EXPECT_THAT(error(), AllOf(HasSubstr("none%d.png: no file has a name like this"),
                             HasSubstr("`apt-get install visp-images-data` brings them")));
  options_.package = "";
  options_.input = (folder_.path() / "none.mp4").string();
  EXPECT_THAT(error(), HasSubstr("none.mp4: there is no such file or folder; correct the path"));
  options_.input = "";
  EXPECT_THAT(error(), HasSubstr("has no name"));
  const test::TempFolder empty;
  options_.input = empty.path().string();
  EXPECT_THAT(error(), HasSubstr("the folder holds no image"));
}

TEST_F(Sequence, RefusesRangesAndRatesThatMakeNoSense) {
  options_.first_frame = 7;
  EXPECT_THAT(error(), HasSubstr("has images 0 to 6, none in the range"));
  options_.first_frame = 3;
  options_.last_frame = 2;
  EXPECT_THAT(error(), HasSubstr("in this order"));
  options_.last_frame = std::nullopt;
  for (const double rate : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    options_.rate_hz = rate;
    EXPECT_THAT(error(), HasSubstr("rate_hz must be positive"));
  }
}

class Video : public Sequence {
 protected:
  static constexpr int kFrames = 12;
  Video() {
    const auto file = folder_.path() / "v.avi";
    cv::VideoWriter writer(file.string(), cv::CAP_OPENCV_MJPEG,
                           cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10, cv::Size(64, 48));
    for (int i = 0; i < kFrames; ++i) {
      writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(10 * i + 5)));
    }
    writer.release();
    options_ = {};
    options_.input = file.string();
  }
};

TEST_F(Video, GivesEveryFrameInGrey) {
  const auto source = open_sequence(options_);
  EXPECT_EQ(source->frame_count(), kFrames);
  const auto frames = all_frames(*source);
  ASSERT_EQ(frames.size(), std::size_t(kFrames));
  for (const Frame& frame : frames) {
    EXPECT_EQ(frame.gray.type(), CV_8UC1);
    // A flat JPEG is off by its quantisation, a few grey levels.
    EXPECT_NEAR(frame.gray.at<uchar>(20, 20), 10 * frame.index + 5, 3);
    EXPECT_NEAR(frame.stamp_s, double(frame.index) / 10, 1e-9);
  }
}

TEST_F(Video, KeepsTheCountWhateverPartIsRead) {
  options_.first_frame = 3;
  options_.last_frame = 5;
  options_.rate_hz = 4;
  const auto source = open_sequence(options_);
  EXPECT_EQ(source->frame_count(), 3);
  const auto frames = all_frames(*source);
  EXPECT_THAT(indices(frames), ElementsAre(3, 4, 5));
  EXPECT_NEAR(frames[0].gray.at<uchar>(20, 20), 35, 3);
  EXPECT_EQ(frames[0].stamp_s, 0.75);
  EXPECT_TRUE(source->skipped().empty());
}

/// Makes the second half of an MP4 file of `pictures` twice as fast: the box stts (ISO/IEC
/// 14496-12, 8.6.1.2) gets a second pair of count and ticks; those around it grow by its eight
/// bytes.
std::string hurried(std::string bytes, int pictures) {
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | std::uint8_t(bytes[i]);
    return value;
  };
  const auto put = [&](std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = char(value >> (24 - 8 * i));
  };
  const std::size_t stts = bytes.find("stts");
  for (const char* box : {"moov", "trak", "mdia", "minf", "stbl", "stts"}) {
    const std::size_t at = bytes.rfind(box, stts) - 4;
    put(at, word(at) + 8);
  }
  const std::uint32_t ticks = word(stts + 16);
  bytes.insert(stts + 20, 8, '\0');
  put(stts + 8, 2);
  put(stts + 12, std::uint32_t(pictures / 2));
  put(stts + 20, std::uint32_t(pictures / 2));
  put(stts + 24, ticks / 2);
  return bytes;
}

TEST_F(Video, StampsAreItsOwnTimes) {
  VideoWriter writer(folder_ / "even.mp4", 25);
  for (int i = 0; i < kFrames; ++i) writer.write(cv::Mat(48, 64, CV_8UC1, cv::Scalar(20 * i)));
  writer.close();
  std::ifstream in(folder_ / "even.mp4", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  options_.input = folder_.write("uneven.mp4", hurried(bytes, kFrames)).string();
  const auto frames = all_frames(*open_sequence(options_));
  ASSERT_EQ(frames.size(), std::size_t(kFrames));
  for (int i = 0; i < kFrames; ++i)
    EXPECT_DOUBLE_EQ(frames[std::size_t(i)].stamp_s, i < 6 ? i / 25. : (6 + i) / 50.) << i;
  options_.rate_hz = 10;  // who asks for a rate gets it
  EXPECT_DOUBLE_EQ(all_frames(*open_sequence(options_))[8].stamp_s, 0.8);
}

TEST_F(Video, SaysThatItEndsEarly) {
  std::ifstream in(options_.input, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  options_.input = folder_.write("cut.avi", bytes.substr(0, bytes.size() / 2)).string();
  const auto source = open_sequence(options_);
  const auto frames = all_frames(*source);
  EXPECT_GT(frames.size(), 2u);
  EXPECT_LT(frames.size(), std::size_t(kFrames));
  ASSERT_EQ(source->skipped().size(), 1u);
  EXPECT_THAT(source->skipped()[0], HasSubstr("the video ends early"));
}

TEST_F(Video, RefusesWhatIsNoVideo) {
  options_.input = folder_.write("junk.mp4", "no video").string();
  EXPECT_THAT(error(), HasSubstr("is no video that FFmpeg can read"));
  options_.input = folder_.write("empty.mp4", "").string();
  EXPECT_THAT(error(), HasSubstr("is no video that FFmpeg can read"));
}

TEST_F(Video, RefusesAFirstFrameBeyondTheEnd) {
  options_.first_frame = 40;
  EXPECT_THAT(error(), HasSubstr("has only 12 frames; lower first_frame"));
}

}  // namespace
}  // namespace kestrel

#include "kestrel/io/camera_mode.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::vector<std::string> kRead = {"grey", "yuyv", "mjpeg"};

// A webcam as they are: large pictures at full rate only compressed.
const std::vector<CameraMode> kWebcam = {
    {"h264", {640, 480}, {60}}, {"mjpeg", {1280, 720}, {30, 15}}, {"mjpeg", {640, 480}, {60, 30}},
    {"yuyv", {320, 240}, {30}}, {"yuyv", {640, 480}, {30, 15}},   {"yuyv", {1280, 720}, {5}}};

std::string chosen(const CaptureSettings& settings) {
  const ChosenMode c = choose_mode(kWebcam, settings, kRead);
  return to_string({c.mode.format, c.mode.size, {c.rate_hz}});
}

CaptureSettings wish(const std::string& format, std::optional<cv::Size> size,
                     std::optional<double> rate_hz) {
  CaptureSettings s;
  s.format = format;
  s.size = size;
  s.rate_hz = rate_hz;
  return s;
}

TEST(ChooseMode, PrefersVgaThenTheBetterFormatThenTheHigherRate) {
  EXPECT_EQ(chosen({}), "yuyv 640x480 at 30 Hz");
}

TEST(ChooseMode, KeepsToWhatIsAskedFor) {
  EXPECT_EQ(chosen(wish("mjpeg", {}, {})), "mjpeg 640x480 at 60 Hz");
  EXPECT_EQ(chosen(wish("", cv::Size(1280, 720), {})), "yuyv 1280x720 at 5 Hz");
  EXPECT_EQ(chosen(wish("", cv::Size(1280, 720), 25)), "mjpeg 1280x720 at 30 Hz");
  EXPECT_EQ(chosen(wish("", {}, 50)), "mjpeg 640x480 at 60 Hz");
  EXPECT_EQ(chosen(wish("", {}, 10)), "yuyv 640x480 at 15 Hz");
  EXPECT_EQ(chosen(wish("yuyv", {}, 30.2)), "yuyv 640x480 at 30 Hz");  // within a hundredth
}

TEST(ChooseMode, SaysWhatThereIsWhenNothingFits) {
  EXPECT_THAT(message_of([] { choose_mode(kWebcam, wish("grey", {}, {}), kRead); }),
              AllOf(HasSubstr("cannot send grey"), HasSubstr("yuyv 640x480 at 30, 15 Hz")));
  EXPECT_THAT(message_of([] { choose_mode(kWebcam, wish("", cv::Size(1, 2), 7), kRead); }),
              HasSubstr("cannot send a picture of 1x2 at 7 Hz"));
  EXPECT_THAT(message_of([] { choose_mode({}, {}, kRead); }), HasSubstr("nothing that it names"));
}

TEST(ChooseMode, BelievesACameraThatNamesNoRates) {
  const ChosenMode c = choose_mode({{"grey", {752, 480}, {}}}, wish("", {}, 60), kRead);
  EXPECT_EQ(c.rate_hz, 60);
  EXPECT_EQ(choose_mode({{"grey", {752, 480}, {}}}, {}, kRead).rate_hz, 0);
}

}  // namespace
}  // namespace kestrel

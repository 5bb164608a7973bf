// There is no camera on the machines that run this: behind DeviceCalls stands a V4L2 driver of the
// tests (v4l2_standin.cpp).
#include "kestrel/io/v4l2_camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/v4l2_standin.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using test::V4l2Fault;
using test::V4l2StandIn;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// What is wrong with a camera of this fault, opened and asked for pictures.
std::string failure_of(V4l2Fault fault, const CaptureSettings& settings = {}) {
  V4l2StandIn driver;
  driver.fault = fault;
  const std::string words = message_of([&] {
    const auto camera = open_v4l2("0", settings, driver);
    for (int k = 0; k < 8; ++k) camera->next();
  });
  EXPECT_EQ(driver.open_descriptors, 0);  // whatever happened, all is given back
  EXPECT_EQ(driver.mapped, 0);
  EXPECT_EQ(driver.wrong_calls, 0);
  return words;
}

TEST(V4l2Camera, GivesPicturesWithTheDriversStamps) {
  V4l2StandIn driver;
  const auto camera = open_v4l2("0", {}, driver);
  double last_s = 0;
  for (int k = 0; k < 10; ++k) {
    const auto picture = camera->next();
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->gray.size(), cv::Size(640, 480));
    EXPECT_EQ(picture->gray.type(), CV_8UC1);
    EXPECT_EQ(picture->gray.at<uchar>(479, 639), 10 * k);
    EXPECT_EQ(picture->lost, 0);
    EXPECT_GT(picture->captured_s, last_s);
    // The driver stamped it 5 ms ago: the stamp must be that, not the time it was taken.
    EXPECT_LE(picture->captured_s, monotonic_clock_s() - 0.004);
    last_s = picture->captured_s;
  }
  EXPECT_EQ(camera->clock(), CaptureClock::Driver);
  EXPECT_EQ(driver.wrong_calls, 0);
}

TEST(V4l2Camera, SetsWhatIsAskedFor) {
  V4l2StandIn driver;
  CaptureSettings settings;
  settings.format = "grey";
  settings.size = cv::Size(752, 480);  // on the grid of its sizes
  settings.rate_hz = 15;
  settings.exposure_s = 0.004;
  settings.gain = 40;
  const auto camera = open_v4l2("/dev/video0", settings, driver);
  EXPECT_EQ(camera->next()->gray.size(), cv::Size(752, 480));
  EXPECT_EQ(driver.rate_hz, 15);
  EXPECT_EQ(driver.controls[V4L2_CID_EXPOSURE_AUTO], V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(driver.controls[V4L2_CID_EXPOSURE_ABSOLUTE], 40);  // of 100 us
  EXPECT_EQ(driver.controls[V4L2_CID_GAIN], 40);
}

TEST(V4l2Camera, LeavesTheControlsAloneWhenNothingIsAskedFor) {
  V4l2StandIn driver;
  open_v4l2("0", {}, driver);
  EXPECT_TRUE(driver.controls.empty());
  EXPECT_EQ(driver.rate_hz, 30);  // the highest of its mode
}

TEST(V4l2Camera, CountsWhatTheDriverLost) {
  V4l2StandIn driver;
  driver.lost = {2, 3, 5};
  const auto camera = open_v4l2("0", {}, driver);
  std::vector<std::int64_t> lost;
  for (int k = 0; k < 5; ++k) lost.push_back(camera->next()->lost);
  EXPECT_THAT(lost, ::testing::ElementsAre(0, 0, 2, 1, 0));
}

TEST(V4l2Camera, GivesADamagedPictureAsDamagedAndGoesOn) {
  for (const V4l2Fault fault : {V4l2Fault::Corrupt, V4l2Fault::CutShort}) {
    V4l2StandIn driver;
    driver.fault = fault;
    const auto camera = open_v4l2("0", {}, driver);
    camera->next();
    camera->next();
    const auto damaged = camera->next();
    ASSERT_TRUE(damaged);
    EXPECT_TRUE(damaged->gray.empty());
    EXPECT_THAT(damaged->damage, HasSubstr(fault == V4l2Fault::Corrupt ? "damaged" : "cut short"));
    EXPECT_EQ(camera->next()->gray.at<uchar>(0, 0), 30);
  }
}

TEST(V4l2Camera, DoesNotBelieveAStampOfAnotherClock) {
  V4l2StandIn driver;
  driver.fault = V4l2Fault::WrongClock;
  const auto camera = open_v4l2("0", {}, driver);
  const double before_s = monotonic_clock_s();
  const auto picture = camera->next();
  EXPECT_GE(picture->captured_s, before_s);
  EXPECT_LE(picture->captured_s, monotonic_clock_s());
  EXPECT_EQ(camera->clock(), CaptureClock::Arrival);
}

TEST(V4l2Camera, SaysWhyItCannotBeOpened) {
  EXPECT_THAT(failure_of(V4l2Fault::Busy), HasSubstr("end the other program"));
  EXPECT_THAT(failure_of(V4l2Fault::Forbidden), HasSubstr("group video"));
  EXPECT_THAT(failure_of(V4l2Fault::NoCapture), HasSubstr("captures no video"));
  EXPECT_THAT(failure_of(V4l2Fault::NoMemory), HasSubstr("it gives no memory"));
  EXPECT_THAT(failure_of(V4l2Fault::NoBandwidth), HasSubstr("no room"));
  EXPECT_THAT(failure_of(V4l2Fault::OtherSize),
              AllOf(HasSubstr("asked for grey 640x480"), HasSubstr("it set grey 320x240")));
  V4l2StandIn driver("/dev/video5");
  EXPECT_THAT(message_of([&] { open_v4l2("0", {}, driver); }),
              AllOf(HasSubstr("/dev/video0: there is no such device"), HasSubstr("connect")));
  EXPECT_THAT(message_of([&] { open_v4l2("front", {}, driver); }), HasSubstr("camera:0"));
}

TEST(V4l2Camera, SaysWhatItCannotSet) {
  CaptureSettings settings;
  settings.size = cv::Size(1, 1);
  EXPECT_THAT(failure_of(V4l2Fault::None, settings),
              AllOf(HasSubstr("cannot send a picture of 1x1"), HasSubstr("yuyv 320x240")));
  settings = {};
  settings.gain = 1000;
  EXPECT_THAT(failure_of(V4l2Fault::None, settings), HasSubstr("gain: the value is out of its"));
}

TEST(V4l2Camera, SaysThatItFailed) {
  EXPECT_THAT(failure_of(V4l2Fault::Unplugged), HasSubstr("/dev/video0: the camera was unplugged"));
  EXPECT_THAT(failure_of(V4l2Fault::IoError), HasSubstr("taking a picture"));
  EXPECT_THAT(failure_of(V4l2Fault::BadIndex), HasSubstr("memory that it did not give"));
}

TEST(V4l2Camera, DoesNotWaitForASilentOne) {
  V4l2StandIn driver;
  driver.fault = V4l2Fault::Silent;
  const auto camera = open_v4l2("0", {}, driver);
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(camera->next());
  EXPECT_FALSE(camera->next());
}

TEST(ListV4l2, NamesCamerasAndWhatTheyCan) {
  V4l2StandIn driver("/dev/video3");
  const auto cameras = list_v4l2(driver);
  ASSERT_EQ(cameras.size(), 1u);
  EXPECT_EQ(cameras[0].path, "/dev/video3");
  EXPECT_EQ(cameras[0].name, "Stand-in camera");
  EXPECT_EQ(cameras[0].bus, "usb-1.2");
  std::vector<std::string> modes;
  for (const CameraMode& mode : cameras[0].modes) modes.push_back(to_string(mode));
  EXPECT_THAT(modes, ::testing::Contains("h264 320x240 at 30, 15 Hz"));
  EXPECT_THAT(modes, ::testing::Contains("yuyv 640x480 at 30, 15 Hz"));
  EXPECT_THAT(modes, ::testing::Contains("grey 16x16 at 30, 15 Hz"));
  EXPECT_THAT(modes, ::testing::Contains("grey 1280x960 at 30, 15 Hz"));
  EXPECT_EQ(driver.open_descriptors, 0);
}

TEST(ListV4l2, LeavesOutWhatIsNoCameraAndKeepsTheOneInUse) {
  V4l2StandIn driver;
  driver.fault = V4l2Fault::NoCapture;
  EXPECT_TRUE(list_v4l2(driver).empty());
  driver.fault = V4l2Fault::Forbidden;
  const auto cameras = list_v4l2(driver);
  ASSERT_EQ(cameras.size(), 1u);
  EXPECT_THAT(cameras[0].trouble, HasSubstr("Permission denied"));
}

}  // namespace
}  // namespace kestrel

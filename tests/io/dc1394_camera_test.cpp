// There is no FireWire camera on the machines that run this: libdc1394 is replaced by the stand-in
// of dc1394_standin.cpp, which ctest preloads.
#include "kestrel/io/dc1394_camera.hpp"

#include <cstdlib>

#include <dc1394/dc1394.h>
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/io/live_camera.hpp"

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using ::testing::HasSubstr;

class Dc1394 : public ::testing::Test {
 protected:
  void SetUp() override {
    frames_out_ = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "kestrel_dc1394_frames_out"));
    if (frames_out_ == nullptr) GTEST_SKIP() << "run by ctest, which preloads the stand-in";
    unsetenv("KESTREL_DC1394_FAULT");
  }
  void TearDown() override { unsetenv("KESTREL_DC1394_FAULT"); }
  static void inject(const char* fault) { setenv("KESTREL_DC1394_FAULT", fault, 1); }
  /// The next picture, waited for as a reader does.
  static Picture next(CameraDevice& camera) {
    for (int k = 0; k < 50; ++k) {
      if (auto picture = camera.next()) return *picture;
    }
    throw std::runtime_error("no picture");
  }
  /// What is wrong after the frames that came.
  static std::string failure_of(const std::string& guid = "", const CaptureSettings& wish = {}) {
    return message_of([&] {
      const auto camera = open_dc1394(guid, wish);
      for (int i = 0; i < 10; ++i) camera->next();
    });
  }
  template <class Value>
  static Value told(const char* symbol) {
    return reinterpret_cast<Value (*)()>(dlsym(RTLD_DEFAULT, symbol))();
  }
  int (*frames_out_)() = nullptr;
};

TEST_F(Dc1394, GivesEveryPictureWithTheStampOfTheBus) {
  const auto camera = open_dc1394("", {});
  double last_s = 0;
  for (int k = 0; k < 6; ++k) {
    const Picture picture = next(*camera);
    EXPECT_EQ(picture.gray.size(), cv::Size(640, 480));
    EXPECT_EQ(picture.gray.at<uchar>(479, 639), k);
    EXPECT_GT(picture.captured_s, last_s);
    // It had filled the bus 7 ms before it was taken.
    EXPECT_LE(picture.captured_s, monotonic_clock_s() - 0.006);
    last_s = picture.captured_s;
    EXPECT_EQ(frames_out_(), 0);
  }
  EXPECT_EQ(camera->clock(), CaptureClock::Driver);
}

TEST_F(Dc1394, SetsWhatIsAskedFor) {
  CaptureSettings wish;
  wish.format = "mono8";
  wish.rate_hz = 10;
  wish.exposure_s = 0.0125;
  wish.gain = 3;
  open_dc1394("", wish);
  EXPECT_EQ(told<int>("kestrel_dc1394_rate"), DC1394_FRAMERATE_15);  // the lowest that reaches 10
  EXPECT_EQ(told<float>("kestrel_dc1394_shutter_s"), 0.0125F);
  EXPECT_EQ(told<float>("kestrel_dc1394_gain"), 3);
  open_dc1394("", {});
  EXPECT_EQ(told<int>("kestrel_dc1394_rate"), DC1394_FRAMERATE_30);
  wish.gain = 1000;
  EXPECT_THAT(failure_of("", wish), HasSubstr("gain: the camera does not take 1000"));
  wish = {};
  wish.size = cv::Size(1024, 768);
  EXPECT_THAT(failure_of("", wish), HasSubstr("cannot send a picture of 1024x768; it has"));
}

TEST_F(Dc1394, DecodesTheColourPatternOfFormat7) {
  inject("format7");
  const auto camera = open_dc1394("", {});
  EXPECT_EQ(next(*camera).gray.at<uchar>(240, 320), 0);
  // All of one value, whatever the pattern: the brightness is that value.
  EXPECT_EQ(next(*camera).gray.at<uchar>(240, 320), 1);
  EXPECT_EQ(frames_out_(), 0);
}

TEST_F(Dc1394, GivesACorruptFrameAsDamagedAndGoesOn) {
  inject("corrupt");
  const auto camera = open_dc1394("0123456789abcdef", {});
  EXPECT_EQ(next(*camera).damage, "");
  const Picture damaged = next(*camera);
  EXPECT_TRUE(damaged.gray.empty());
  EXPECT_EQ(damaged.damage, "arrived corrupt");
  EXPECT_EQ(next(*camera).gray.at<uchar>(0, 0), 2);
  EXPECT_EQ(frames_out_(), 0);
}

TEST_F(Dc1394, DoesNotWaitForAnUnpluggedCamera) {
  inject("unplugged");
  const auto camera = open_dc1394("", {});
  for (int k = 0; k < 3; ++k) next(*camera);
  EXPECT_FALSE(camera->next());
}

TEST_F(Dc1394, ComesBackAfterABusReset) {
  inject("bus_reset");
  LiveOptions options;
  options.retry_s = 0.01;
  const auto source = open_live("dc1394", options);
  while (live_status(*source)->connections < 2) source->next();
  for (int k = 0; k < 50 && !has_image(*source->next()); ++k) continue;
  EXPECT_THAT(source->skipped().at(0), HasSubstr("taking a frame; check the cable"));
}

TEST_F(Dc1394, AreListedWithTheirModes) {
  const auto cameras = list_dc1394();
  ASSERT_EQ(cameras.size(), 1u);
  EXPECT_EQ(cameras[0].guid, "0123456789abcdef");
  EXPECT_EQ(cameras[0].name, "Stand-in IIDC");
  ASSERT_EQ(cameras[0].modes.size(), 2u);
  EXPECT_EQ(to_string(cameras[0].modes[0]), "yuv411 640x480 at 30, 15 Hz");
  EXPECT_EQ(to_string(cameras[0].modes[1]), "mono8 640x480 at 30, 15 Hz");
  inject("no_bus");
  EXPECT_TRUE(list_dc1394().empty());
  inject("no_camera");
  EXPECT_TRUE(list_dc1394().empty());
}

TEST_F(Dc1394, SaysThatTakingAFrameFails) {
  inject("dequeue_error");
  EXPECT_THAT(failure_of(), HasSubstr("taking a frame; check the cable"));
}

TEST_F(Dc1394, SaysWhyItCannotBeOpened) {
  inject("no_bus");
  EXPECT_THAT(failure_of(), HasSubstr("the FireWire bus cannot be opened"));
  inject("no_camera");
  EXPECT_THAT(failure_of(), HasSubstr("no camera on the FireWire bus"));
  inject("odd_modes");
  EXPECT_THAT(failure_of(), HasSubstr("in the formats that are read"));
  inject("no_bandwidth");
  EXPECT_THAT(failure_of(), HasSubstr("reserving the bus"));
  inject("none");
  EXPECT_THAT(failure_of("12"), HasSubstr("there is 0123456789abcdef"));
  EXPECT_THAT(failure_of("front"), HasSubstr("'front' is no GUID"));
}

}  // namespace
}  // namespace kestrel

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
    TearDown();
  }
  void TearDown() override {
    unsetenv("KESTREL_DC1394_FAULT");
    unsetenv("KESTREL_DC1394_CODING");
  }
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

TEST_F(Dc1394, TakesTheHighestSpeedOfTheBus) {
  open_dc1394("", {});
  EXPECT_EQ(told<int>("kestrel_dc1394_speed"), DC1394_ISO_SPEED_400);
  inject("b_mode");
  open_dc1394("", {});
  EXPECT_EQ(told<int>("kestrel_dc1394_speed"), DC1394_ISO_SPEED_800);
  inject("no_800");
  open_dc1394("", {});
  EXPECT_EQ(told<int>("kestrel_dc1394_speed"), DC1394_ISO_SPEED_400);
}

TEST_F(Dc1394, ReadsEveryFormatItNames) {
  const std::vector<std::pair<const char*, int>> formats = {
      {"mono8", DC1394_COLOR_CODING_MONO8},   {"mono16", DC1394_COLOR_CODING_MONO16},
      {"yuv422", DC1394_COLOR_CODING_YUV422}, {"yuv444", DC1394_COLOR_CODING_YUV444},
      {"yuv411", DC1394_COLOR_CODING_YUV411}, {"rgb8", DC1394_COLOR_CODING_RGB8},
      {"rgb16", DC1394_COLOR_CODING_RGB16},   {"raw8", DC1394_COLOR_CODING_RAW8},
      {"raw16", DC1394_COLOR_CODING_RAW16}};
  for (const auto& [name, coding] : formats) {
    setenv("KESTREL_DC1394_CODING", std::to_string(coding).c_str(), 1);
    CaptureSettings wish;
    wish.format = name;
    const auto camera = open_dc1394("", wish);
    next(*camera);
    const Picture second = next(*camera);
    ASSERT_EQ(second.gray.size(), cv::Size(640, 480)) << name;
    const bool is_raw = name[0] == 'r' && name[1] == 'a';
    // Within the border of one pixel, which libdc1394 leaves black when it decodes a pattern.
    for (int i = 1; i < 639; i += 9)
      EXPECT_EQ(second.gray.at<uchar>(478, i), 1 + (is_raw ? 0 : 10 * (i % 4))) << name << i;
    EXPECT_EQ(frames_out_(), 0);
  }
}

TEST_F(Dc1394, WaitsForItsTriggerWhereOneIsAskedFor) {
  next(*open_dc1394("", {}));
  EXPECT_EQ(told<int>("kestrel_dc1394_trigger_power"), DC1394_OFF);  // as it was found: on
  CaptureSettings wish;
  wish.trigger = TriggerSettings{"1", 14, "low"};
  next(*open_dc1394("", wish));
  EXPECT_EQ(told<int>("kestrel_dc1394_trigger_power"), DC1394_ON);
  EXPECT_EQ(told<int>("kestrel_dc1394_trigger_source"), DC1394_TRIGGER_SOURCE_1);
  EXPECT_EQ(told<int>("kestrel_dc1394_trigger_mode"), DC1394_TRIGGER_MODE_14);
  EXPECT_EQ(told<int>("kestrel_dc1394_trigger_polarity"), DC1394_TRIGGER_ACTIVE_LOW);
  wish.trigger->polarity = "high";
  open_dc1394("", wish);
  EXPECT_EQ(told<int>("kestrel_dc1394_trigger_polarity"), DC1394_TRIGGER_ACTIVE_HIGH);
}

TEST_F(Dc1394, SaysWhatTheTriggerCannotDo) {
  CaptureSettings wish;
  wish.trigger = TriggerSettings{"2", 0, ""};
  EXPECT_THAT(failure_of("", wish),
              HasSubstr("trigger.source: the camera has no source 2; it has 1, software"));
  wish.trigger = TriggerSettings{"1", 3, ""};
  EXPECT_THAT(failure_of("", wish),
              HasSubstr("trigger.mode: the camera has no mode 3; it has 0, 14"));
  inject("fixed_polarity");
  wish.trigger = TriggerSettings{"1", 0, "low"};
  EXPECT_THAT(failure_of("", wish), HasSubstr("trigger.polarity: that of this camera cannot be"));
  inject("no_trigger_feature");
  EXPECT_THAT(failure_of("", wish), HasSubstr("trigger: the camera has none; remove the key"));
  EXPECT_EQ(failure_of("", {}), "nothing was thrown");
}

// The stand-in fails when it is asked for a picture before the last one came.
TEST_F(Dc1394, IsTriggeredByTheProgramOnePictureAtATime) {
  CaptureSettings wish;
  wish.trigger = TriggerSettings{"software", 0, ""};
  const auto camera = open_dc1394("", wish);
  for (int k = 0; k < 6; ++k) EXPECT_EQ(next(*camera).gray.at<uchar>(0, 0), k);
  wish.rate_hz = 25;
  const auto slow = open_dc1394("", wish);
  next(*slow);
  const double start_s = monotonic_clock_s();
  for (int k = 0; k < 3; ++k) next(*slow);
  EXPECT_GE(monotonic_clock_s() - start_s, 2 / 25.);  // of three periods one may have begun
  inject("no_software_trigger");
  EXPECT_THAT(failure_of("", wish), HasSubstr("triggering a picture"));
}

// A trigger that does not come is a camera that is silent: the source says so, by name, and
// neither waits for ever nor takes it for a broken one.
TEST_F(Dc1394, SaysThatNoTriggerComes) {
  inject("no_trigger");
  LiveOptions options;
  options.capture.trigger = TriggerSettings{"1", 0, ""};
  options.open_timeout_s = 0.25;
  options.stall_timeout_s = 0.1;
  options.retry_s = options.longest_retry_s = 0.02;
  const auto source = open_live("dc1394", options);
  const double start_s = monotonic_clock_s();
  EXPECT_THAT(message_of([&] { source->next(); }),
              HasSubstr("no trigger within 0.1 s (source 1, mode 0); check its cable"));
  EXPECT_LT(monotonic_clock_s() - start_s, 10);  // and not for ever
  EXPECT_GE(live_status(*source)->connections, 1);
  inject("none");  // it comes
  while (!has_image(*source->next())) continue;
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
  ASSERT_TRUE(cameras[0].trigger.has_value());
  EXPECT_EQ(to_string(*cameras[0].trigger),
            "sources 1, software; modes 0, 14; polarity high or low");
  inject("no_trigger_feature");
  EXPECT_FALSE(list_dc1394().at(0).trigger.has_value());
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

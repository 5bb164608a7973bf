#include "kestrel/io/live_camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/quick_live.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using test::quick;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(OpenLive, SaysWhatAnAddressMayBe) {
  EXPECT_THAT(message_of([] { open_live("ftp://x"); }),
              AllOf(HasSubstr("is 'ftp://x'"), HasSubstr("camera:N")));
  EXPECT_THAT(message_of([] { open_live("video:v.mp4"); }), HasSubstr("is no live camera"));
  EXPECT_THAT(message_of([] { open_live("camera:front"); }), HasSubstr("is not a number"));
  EXPECT_THROW(open_live("camera:0", quick(0, 1)), std::invalid_argument);
}

TEST(OpenLive, NamesTheDeviceThatIsMissing) {
  EXPECT_THAT(message_of([] { open_live("camera:99"); }),
              AllOf(HasSubstr("/dev/video99: there is no such device"), HasSubstr("connect")));
}

TEST(OpenLive, SaysThatNobodyAnswers) {
  // Port 1 of the loopback: nothing listens there, and the refusal is at once.
  EXPECT_THAT(message_of([] { open_live("http://127.0.0.1:1/video", quick(0.1, 1)); }),
              AllOf(HasSubstr("no video (Connection refused)"), HasSubstr("check the address")));
  const double start_s = monotonic_clock_s();
  EXPECT_THAT(message_of([] { open_live("udp://127.0.0.1:45999", quick(0.3, 1)); }),
              HasSubstr("no video within 0.3 s"));
  EXPECT_LT(monotonic_clock_s() - start_s, 5);
}

TEST(OpenLive, AStreamHasNoSettings) {
  LiveOptions options;
  options.capture.gain = 1;
  EXPECT_THAT(message_of([&] { open_live("udp://127.0.0.1:45999", options); }),
              HasSubstr("a network stream comes as it is sent"));
}

TEST(OpenLive, OnlyAFireWireCameraHasATrigger) {
  LiveOptions options;
  options.capture.trigger.emplace();
  for (const char* address : {"camera:0", "udp://127.0.0.1:45999"})
    EXPECT_THROW(open_live(address, options), std::invalid_argument) << address;
  EXPECT_THAT(message_of([&] { open_live("camera:0", options); }),
              HasSubstr("trigger: only a FireWire camera (dc1394) is triggered"));
}

}  // namespace
}  // namespace kestrel

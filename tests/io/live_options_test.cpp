#include "kestrel/io/live_options.hpp"

#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using ::testing::HasSubstr;

std::string refusal(const std::function<void(LiveOptions&)>& change) {
  LiveOptions options;
  change(options);
  return message_of([&] { options.check(); });
}

TEST(LiveOptions, DefaultsAreGood) {
  EXPECT_NO_THROW(LiveOptions().check());
  EXPECT_TRUE(CaptureSettings().is_empty());
}

TEST(LiveOptions, CheckNamesTheOptionOutOfRange) {
  EXPECT_THAT(refusal([](LiveOptions& o) { o.open_timeout_s = 0; }), HasSubstr("open_timeout_s"));
  EXPECT_THAT(refusal([](LiveOptions& o) { o.stall_timeout_s = std::nan(""); }),
              HasSubstr("stall_timeout_s"));
  EXPECT_THAT(refusal([](LiveOptions& o) { o.blind_s = -1; }), HasSubstr("blind_s"));
  EXPECT_THAT(refusal([](LiveOptions& o) { o.give_up_s = HUGE_VAL; }), HasSubstr("give_up_s"));
  EXPECT_THAT(refusal([](LiveOptions& o) { o.longest_retry_s = 0.1; }),
              HasSubstr("longest_retry_s"));
  EXPECT_THAT(refusal([](LiveOptions& o) { o.queue_pictures = 0; }), HasSubstr("queue_pictures"));
  EXPECT_THAT(refusal([](LiveOptions& o) { o.capture.size = cv::Size(640, 0); }),
              HasSubstr("size_px"));
  EXPECT_THAT(refusal([](LiveOptions& o) { o.capture.rate_hz = 0; }), HasSubstr("rate_hz"));
  EXPECT_THAT(refusal([](LiveOptions& o) { o.capture.exposure_s = 0; }), HasSubstr("exposure_s"));
  EXPECT_THAT(refusal([](LiveOptions& o) { o.capture.gain = -1; }), HasSubstr("gain"));
  const auto trigger = [](const TriggerSettings& t) {
    return refusal([&](LiveOptions& o) { o.capture.trigger = t; });
  };
  EXPECT_THAT(trigger({"4", 0, ""}), HasSubstr("trigger.source: must be 0, 1, 2, 3 or software"));
  EXPECT_THAT(trigger({"0", 6, ""}), HasSubstr("trigger.mode: must be 0 to 5, 14 or 15"));
  EXPECT_THAT(trigger({"0", 15, "up"}), HasSubstr("trigger.polarity: must be high or low"));
}

TEST(RetryDelay, DoublesUpToTheLongest) {
  LiveOptions options;
  options.retry_s = 0.5;
  options.longest_retry_s = 3;
  EXPECT_EQ(retry_delay_s(0, options), 0.5);
  EXPECT_EQ(retry_delay_s(1, options), 1);
  EXPECT_EQ(retry_delay_s(2, options), 2);
  EXPECT_EQ(retry_delay_s(3, options), 3);
  EXPECT_EQ(retry_delay_s(1000000, options), 3);
}

}  // namespace
}  // namespace kestrel

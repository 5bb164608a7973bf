#include "kestrel/io/live_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/scripted_camera.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::CameraScript;
using test::message_of;
using test::quick;
using ::testing::AllOf;
using ::testing::HasSubstr;

LiveSource source_of(CameraScript& script, const LiveOptions& options = quick()) {
  return {"camera:x", test::opener(script), options, FirstOpening::Once};
}

/// The next frames until one has an image as wanted; what came before is looked at by `look`.
template <class Look>
Frame next_with(LiveSource& source, bool image, const Look& look) {
  for (int k = 0; k < 2000; ++k) {
    const auto frame = source.next();
    if (has_image(*frame) == image) return *frame;
    look(*frame);
  }
  throw std::runtime_error("no such frame came");
}
Frame next_with(LiveSource& source, bool image) {
  return next_with(source, image, [](const Frame&) {});
}

void wait_ms(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

TEST(LiveSource, GivesTheLatestPictureAndCountsTheOthersAsGaps) {
  CameraScript script;
  LiveOptions options = quick();
  options.blind_s = 20;  // no frame without an image: they have numbers too
  LiveSource source = source_of(script, options);
  std::int64_t index = -1;
  double stamp_s = -1;
  for (int k = 0; k < 4; ++k) {
    const Frame frame = next_with(source, true);
    EXPECT_GT(frame.index, index);
    EXPECT_GT(frame.stamp_s, stamp_s);
    EXPECT_EQ(frame.gray.at<uchar>(0, 0), frame.index % 250);  // the index is the picture's number
    index = frame.index;
    stamp_s = frame.stamp_s;
    wait_ms(20);
  }
  EXPECT_GT(index, 6);  // it slept for four pictures each time
  const LiveStatus status = source.status();
  EXPECT_GT(status.dropped, 3);
  EXPECT_EQ(status.connections, 1);
  EXPECT_EQ(status.clock, CaptureClock::Driver);
  EXPECT_EQ(status.trouble, "");
  EXPECT_TRUE(source.skipped().empty());
}

TEST(LiveSource, TellsTheLoopThatItIsBlindAndConnectsAgain) {
  CameraScript script;
  LiveSource source = source_of(script);
  const Frame seen = next_with(source, true);
  script.is_there = false;
  const Frame blind = next_with(source, false);
  EXPECT_GT(blind.stamp_s, seen.stamp_s);
  EXPECT_GT(blind.index, seen.index);
  const Frame more = next_with(source, false);
  EXPECT_GT(more.stamp_s, blind.stamp_s);
  double stamp_s = more.stamp_s;
  EXPECT_NE(source.status().trouble, "");
  script.is_there = true;
  const Frame again = next_with(source, true, [&](const Frame& b) {
    EXPECT_GT(b.stamp_s, stamp_s);
    stamp_s = b.stamp_s;
  });
  EXPECT_GT(again.stamp_s, stamp_s);
  EXPECT_EQ(source.status().connections, 2);
  EXPECT_GT(source.status().longest_silence_s, 0.1);  // two frames without an image
  ASSERT_EQ(source.skipped().size(), 1u);
  EXPECT_EQ(source.skipped()[0], "scripted: unplugged; connecting again");
}

TEST(LiveSource, OpensASilentCameraAgain) {
  CameraScript script;
  LiveOptions options = quick();
  options.stall_timeout_s = 0.05;
  LiveSource source = source_of(script, options);
  next_with(source, true);
  script.is_silent = true;
  next_with(source, false);
  while (script.openings < 3) EXPECT_FALSE(has_image(*source.next()));
  script.is_silent = false;
  next_with(source, true);
  EXPECT_THAT(source.skipped()[0], HasSubstr("camera:x: no picture for 0.05 s"));
}

TEST(LiveSource, TriesAgainWithGrowingPauses) {
  CameraScript script;
  LiveOptions options = quick();
  options.retry_s = 0.01;
  options.longest_retry_s = 10;
  LiveSource source = source_of(script, options);
  next_with(source, true);
  script.is_there = false;
  const double start_s = monotonic_clock_s();
  while (script.attempts < 5) source.next();
  // Four attempts after pauses of 10, 20, 40 and 80 ms.
  EXPECT_GE(monotonic_clock_s() - start_s, 0.145);
}

TEST(LiveSource, FailsWhenNothingCameForLong) {
  CameraScript script;
  LiveOptions options = quick();
  options.give_up_s = 0.05;
  LiveSource source = source_of(script, options);
  next_with(source, true);
  script.is_there = false;
  EXPECT_THAT(message_of([&] {
                while (source.next()) continue;
              }),
              AllOf(HasSubstr("camera:x: no picture for"), HasSubstr("scripted: no such camera")));
}

TEST(LiveSource, RefusesPicturesOfAnotherSize) {
  CameraScript script;
  LiveSource source = source_of(script);
  next_with(source, true);
  script.width_px = 16;
  next_with(source, false);
  wait_ms(20);
  EXPECT_GT(source.status().damaged, 1);
  EXPECT_EQ(source.status().connections, 1);  // a camera that sends is not opened again
  script.width_px = 8;
  const Frame frame = next_with(source, true);
  EXPECT_EQ(frame.gray.cols, 8);
  ASSERT_EQ(source.skipped().size(), 1u);  // said once, not for each picture
  EXPECT_THAT(source.skipped()[0], HasSubstr("is of 16 x 6 px, the first was of 8 x 6"));
}

TEST(LiveSource, CountsDamagedPicturesAsGaps) {
  CameraScript script;
  script.damaged_every = 2;
  LiveOptions options = quick();
  options.blind_s = 20;
  options.queue_pictures = 50;
  LiveSource source = source_of(script, options);
  for (int k = 0; k < 5; ++k) EXPECT_EQ(next_with(source, true).index, 2 * k);
  EXPECT_GE(source.status().damaged, 4);
  EXPECT_EQ(source.status().dropped, 0);
}

TEST(LiveSource, WaitsForASenderThatStartsLate) {
  CameraScript script;
  script.is_there = false;
  EXPECT_THAT(message_of([&] { source_of(script); }), HasSubstr("no such camera"));
  EXPECT_EQ(script.attempts, 1);
  LiveOptions options = quick();
  options.open_timeout_s = 20;
  std::thread late([&] {
    wait_ms(40);
    script.is_there = true;
  });
  LiveSource source("udp://x", test::opener(script), options, FirstOpening::UntilTimeout);
  EXPECT_TRUE(has_image(*source.next()));
  late.join();
  script.is_there = false;
  options.open_timeout_s = 0.05;
  const double start_s = monotonic_clock_s();
  EXPECT_THROW(LiveSource("udp://x", test::opener(script), options, FirstOpening::UntilTimeout),
               std::runtime_error);
  EXPECT_LT(monotonic_clock_s() - start_s, 5);  // no hang, on however slow a machine
}

TEST(LiveSource, TheFirstFrameHasAnImageOrThereIsNone) {
  CameraScript script;
  script.is_silent = true;
  LiveOptions options = quick();
  options.open_timeout_s = 0.03;
  LiveSource source = source_of(script, options);
  EXPECT_THAT(message_of([&] { source.next(); }), HasSubstr("no picture for"));
}

TEST(LiveSource, IsKnownByItsStamps) {
  CameraScript script;
  const LiveSource source = source_of(script);
  EXPECT_EQ(stamp_origin_s(source), source.stamp_origin_s());
  EXPECT_TRUE(live_status(source));
  LiveOptions wrong = quick();
  wrong.blind_s = 0;
  EXPECT_THROW(source_of(script, wrong), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

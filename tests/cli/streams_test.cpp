// Network streams against FFmpeg and GStreamer as their senders, on loopback: each starts late,
// stops, stalls, changes the size, and comes back. The times are printed, since they are what a
// user wants to know; what is tested is that nothing hangs, that the source says when it is blind
// and that it recovers.
#include <cstdio>
#include <fstream>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "kestrel/io/live_camera.hpp"

#include "cli/stream_ways.hpp"
#include "cli/video_sender.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::StreamWay;
using test::VideoSender;

constexpr double kLongest_s = 60;  // for what happens within a second on a machine that is free

LiveOptions options() {
  LiveOptions o;
  o.open_timeout_s = kLongest_s;
  o.stall_timeout_s = 1;
  o.give_up_s = 2 * kLongest_s;
  o.longest_retry_s = 0.5;
  return o;
}

/// A source that is asked for frames as the loop does, and how long each took to come.
class Watched {
 public:
  explicit Watched(std::unique_ptr<LiveSource> source) : source_(std::move(source)) {}

  /// Seconds until a frame with, or without, an image; kLongest_s when none came.
  double wait_for(bool image) {
    const double start_s = monotonic_clock_s();
    while (monotonic_clock_s() - start_s < kLongest_s) {
      const double ask_s = monotonic_clock_s();
      const auto frame = source_->next();
      longest_s_ = std::max(longest_s_, monotonic_clock_s() - ask_s);
      EXPECT_GT(frame->stamp_s, stamp_s_);
      stamp_s_ = frame->stamp_s;
      if (has_image(*frame) == image) return monotonic_clock_s() - start_s;
    }
    return kLongest_s;
  }
  double longest_s() const { return longest_s_; }
  LiveStatus status() const { return source_->status(); }

 private:
  std::unique_ptr<LiveSource> source_;
  double longest_s_ = 0;
  double stamp_s_ = -1;
};

void wait_s(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

/// The sender, started anew.
void start(std::unique_ptr<VideoSender>& sender, const StreamWay& way,
           const test::TempFolder& folder, int width) {
  sender.reset();
  sender = std::make_unique<VideoSender>(way.sender(width), folder.path());
}

/// Waits until something is true, the frames being taken meanwhile.
template <class Condition>
bool comes(Watched& source, const Condition& condition) {
  const double start_s = monotonic_clock_s();
  while (!condition() && monotonic_clock_s() - start_s < kLongest_s) source.wait_for(false);
  return condition();
}

class Streams : public ::testing::TestWithParam<int> {};

TEST_P(Streams, ComeBackWhateverTheSenderDoes) {
  const test::TempFolder folder;
  const std::vector<StreamWay> all = test::stream_ways(folder);
  ASSERT_EQ(all.size(), std::size_t(test::kStreamWays));
  const StreamWay& way = all.at(std::size_t(GetParam()));
  const auto server = way.server();
  std::unique_ptr<VideoSender> sender;

  std::thread late([&] {
    wait_s(0.7);
    start(sender, way, folder, 320);
  });
  const double start_s = monotonic_clock_s();
  Watched source(open_live(way.address, options()));
  late.join();
  EXPECT_LT(source.wait_for(true), kLongest_s);
  const double late_s = monotonic_clock_s() - start_s - 0.7;

  sender.reset();  // it ends
  const double blind_s = source.wait_for(false);
  start(sender, way, folder, 320);
  const double restart_s = source.wait_for(true);
  EXPECT_LT(restart_s, kLongest_s);

  sender->stall();
  EXPECT_LT(source.wait_for(false), kLongest_s);
  const auto before = source.status().connections;
  EXPECT_TRUE(comes(source, [&] {
    return source.status().trouble != "" || source.status().connections > before;
  }));
  sender->go_on();
  if (way.serves_once) start(sender, way, folder, 320);
  const double stall_s = source.wait_for(true);
  EXPECT_LT(stall_s, kLongest_s);

  start(sender, way, folder, 160);  // another size: refused
  EXPECT_TRUE(comes(source, [&] { return source.status().damaged > 0; }));
  start(sender, way, folder, 320);
  const double size_s = source.wait_for(true);
  EXPECT_LT(size_s, kLongest_s);

  // No call of next() waited longer than it promises; the slack is for a machine that is not free.
  EXPECT_LT(source.longest_s(), options().blind_s + 5);
  std::printf(
      "%-24s first picture %.2f s after a late start; blind %.2f s after the end; back %.2f s "
      "after a restart, %.2f s after a stall, %.2f s after another size; longest wait %.2f s; %d "
      "connections\n",
      way.name.c_str(), late_s, blind_s, restart_s, stall_s, size_s, source.longest_s(),
      int(source.status().connections));
}

INSTANTIATE_TEST_SUITE_P(All, Streams, ::testing::Range(0, test::kStreamWays));

}  // namespace
}  // namespace kestrel

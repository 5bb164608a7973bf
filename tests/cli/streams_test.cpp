// Network streams against FFmpeg as their sender, on loopback: it starts late, stops, stalls,
// changes the size, and comes back. The times are printed, since they are what a user wants to
// know; what is tested is that nothing hangs, that the source says when it is blind and that it
// recovers.
#include <cstdio>
#include <fstream>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "kestrel/io/live_camera.hpp"

#include "cli/rtsp_server.hpp"
#include "cli/video_sender.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::VideoSender;
using test::VideoStream;

constexpr double kLongest_s = 60;  // for what happens within a second on a machine that is free

/// One way for pictures to come.
struct Way {
  std::string name;
  std::string address;
  std::vector<std::string> output;
  int rtsp_port = 0;  // where an RtspServer is wanted, and which port FFmpeg feeds it at
  int feed_port = 0;
};

std::string write_sdp(const test::TempFolder& folder, int port) {
  return folder
      .write("stream.sdp",
             "v=0\r\no=- 0 0 IN IP4 127.0.0.1\r\ns=test\r\nc=IN IP4 127.0.0.1\r\nt=0 0\r\n"
             "m=video " +
                 std::to_string(port) + " RTP/AVP 96\r\na=rtpmap:96 H264/90000\r\n")
      .string();
}

std::vector<Way> ways(const test::TempFolder& folder) {
  std::vector<Way> all;
  const std::string host = "127.0.0.1:";
  const int udp = test::free_port();
  all.push_back({"udp, MPEG-TS", "udp://" + host + std::to_string(udp), test::mpeg_over_udp(udp)});
  const int rtp = test::free_port();
  const std::string rtp_url = "rtp://" + host + std::to_string(rtp);
  all.push_back(
      {"rtp, MPEG-TS",
       rtp_url,
       {"-c:v", "mpeg2video", "-q:v", "2", "-g", "5", "-bf", "0", "-f", "rtp_mpegts", rtp_url}});
  const int h264 = test::free_port();
  all.push_back({"rtp, H.264",
                 "rtp:" + write_sdp(folder, h264),
                 {"-c:v", "libx264", "-preset", "ultrafast", "-tune", "zerolatency", "-g", "10",
                  "-bsf:v", "dump_extra", "-f", "rtp", "rtp://" + host + std::to_string(h264)}});
  const std::string http = "http://" + host + std::to_string(test::free_port()) + "/video";
  all.push_back(
      {"http, MJPEG", http, {"-c:v", "mjpeg", "-q:v", "3", "-f", "mpjpeg", "-listen", "1", http}});
  const int rtsp = test::free_port();
  const int feed = test::free_port();
  all.push_back({"rtsp, MPEG-TS", "rtsp://" + host + std::to_string(rtsp) + "/video",
                 test::mpeg_over_udp(feed), rtsp, feed});
  return all;
}

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
void start(std::unique_ptr<VideoSender>& sender, const Way& way, const test::TempFolder& folder,
           int width) {
  sender.reset();
  sender = std::make_unique<VideoSender>(
      VideoStream{test::test_picture(width, width * 3 / 4), way.output}, folder.path());
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
  const Way way = ways(folder).at(std::size_t(GetParam()));
  std::unique_ptr<test::RtspServer> server;
  if (way.rtsp_port > 0) server = std::make_unique<test::RtspServer>(way.rtsp_port, way.feed_port);
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
  // A sender that serves one viewer once (FFmpeg over HTTP) ends when it has lost that one.
  if (way.name.rfind("http", 0) == 0) start(sender, way, folder, 320);
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
      "%-13s first picture %.2f s after a late start; blind %.2f s after the end; back %.2f s "
      "after a restart, %.2f s after a stall, %.2f s after another size; longest wait %.2f s; %d "
      "connections\n",
      way.name.c_str(), late_s, blind_s, restart_s, stall_s, size_s, source.longest_s(),
      int(source.status().connections));
}

INSTANTIATE_TEST_SUITE_P(All, Streams, ::testing::Range(0, 5));

}  // namespace
}  // namespace kestrel

// How old a picture is when its command is decided, by source. A sender draws the time into each
// picture as black and white bars; the frame that comes out of the source says so when it was
// drawn, whatever stamps say. FFmpeg encodes and sends; V4L2 is the tests' driver, whose pictures
// were captured when its stamp says. The times are the machine's: read them beside each other.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "kestrel/io/live_camera.hpp"
#include "kestrel/io/v4l2_camera.hpp"
#include "kestrel/loop/step.hpp"
#include "kestrel/sim/texture.hpp"

#include "cli/video_sender.hpp"
#include "io/v4l2_standin.hpp"

namespace kestrel {
namespace {

constexpr int kBits = 16;  // of milliseconds: a minute
constexpr int kBar_px = 20;
constexpr int kPeriod_ms = 40;
constexpr int kPictures = 200;
const cv::Size kSize(320, 240);

/// A poster with the time of the monotonic clock above it.
cv::Mat stamped(const cv::Mat& poster_picture, double now_s) {
  cv::Mat picture(kSize, CV_8UC1, cv::Scalar(128));
  poster_picture.copyTo(picture(cv::Rect(100, 80, poster_picture.cols, poster_picture.rows)));
  const auto ms = unsigned(std::int64_t(now_s * 1e3) % (1 << kBits));
  for (int bit = 0; bit < kBits; ++bit) {
    const cv::Rect bar(bit * kBar_px, 0, kBar_px, kBar_px);
    picture(bar).setTo((ms >> bit & 1U) != 0 ? 235 : 20);
  }
  return picture;
}

/// How long ago the time in a picture was, ms.
double age_ms(const cv::Mat& gray, double now_s) {
  unsigned ms = 0;
  for (int bit = 0; bit < kBits; ++bit) {
    const bool is_set = gray.at<uchar>(kBar_px / 2, bit * kBar_px + kBar_px / 2) > 128;
    ms |= is_set ? 1U << bit : 0U;
  }
  const double now = std::fmod(now_s * 1e3, 1 << kBits);
  return std::fmod(now - double(ms) + (1 << kBits), 1 << kBits);
}

Task task() {
  CameraParameters p;
  p.px = p.py = 300;
  p.u0 = 159.5;
  p.v0 = 119.5;
  p.width = kSize.width;
  p.height = kSize.height;
  Mount mount;
  mount.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  TargetPose goal;
  goal.translation = {0, 0, 2};
  return {Camera(p), mount, 0.4, 0.4, goal, {}, {}, {}, {}, {}};
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.empty() ? -1 : values[std::size_t(share * double(values.size() - 1))];
}

void report(const char* what, const std::vector<double>& ms) {
  std::printf("  %-34s median %6.1f ms, 95 %% %6.1f ms\n", what, quantile(ms, 0.5),
              quantile(ms, 0.95));
}

/// Takes pictures down the chain; age(frame, now) is the true one, ms.
void measure(const std::string& name, LiveSource& source,
             const std::function<double(const Frame&, double)>& age) {
  const Task wanted = task();
  std::optional<Frame> frame = source.next();
  Tracker tracker(frame->gray, {100, 80, 120, 120}, wanted.track);
  LoopState state = start(tracker, *frame);
  std::vector<double> in_hand;
  std::vector<double> stamp;
  std::vector<double> command;
  while (int(command.size()) < kPictures) {
    frame = source.next();
    if (!has_image(*frame)) continue;
    const double taken_s = monotonic_clock_s();
    in_hand.push_back(age(*frame, taken_s));
    stamp.push_back(1e3 * (taken_s - source.stamp_origin_s() - frame->stamp_s));
    Step now = step(tracker, *frame, state, wanted);
    state = now.next;
    command.push_back(age(*frame, monotonic_clock_s()));
  }
  const LiveStatus status = source.status();
  std::printf("%s (%d pictures, %d not taken in time, stamped by the %s)\n", name.c_str(),
              kPictures, int(status.dropped), kestrel::name(status.clock));
  report("drawn to frame in the loop", in_hand);
  report("of that, known by its stamp", stamp);
  report("drawn to command", command);
}

/// Draws into FFmpeg's input until it is told to stop.
class StampedSender {
 public:
  explicit StampedSender(const std::string& output)
      : pipe_(popen(("ffmpeg -loglevel error -probesize 32 -f rawvideo -pix_fmt gray -s 320x240 "
                     "-framerate 25 -i - -an -threads 1 -pix_fmt yuv420p " +
                     output)
                        .c_str(),
                    "w")),
        thread_([this] { draw(); }) {}
  ~StampedSender() {
    stop_ = true;
    thread_.join();
    pclose(pipe_);
  }
  StampedSender(const StampedSender&) = delete;
  StampedSender& operator=(const StampedSender&) = delete;

 private:
  void draw() {
    const cv::Mat picture = poster(120, 120, 7);
    while (!stop_) {
      const cv::Mat now = stamped(picture, monotonic_clock_s());
      if (std::fwrite(now.data, 1, now.total(), pipe_) != now.total()) return;
      std::fflush(pipe_);
      std::this_thread::sleep_for(std::chrono::milliseconds(kPeriod_ms));
    }
  }
  std::atomic<bool> stop_{false};
  std::FILE* pipe_;
  std::thread thread_;
};

void measure_stream(const std::string& name, const std::string& address,
                    const std::string& output) {
  const StampedSender sender(output);
  LiveOptions options;
  options.open_timeout_s = 30;
  const auto source = open_live(address, options);
  measure(name, *source,
          [](const Frame& frame, double now_s) { return age_ms(frame.gray, now_s); });
}

void measure_v4l2() {
  test::V4l2StandIn driver;
  driver.period_ms = kPeriod_ms;
  driver.stamp_age_s = 0;
  driver.pixels = stamped(poster(120, 120, 7), 0);
  LiveOptions options;
  options.capture.format = "grey";
  options.capture.size = kSize;
  LiveSource source(
      "camera:0", [&](const StopAsked&, double) { return open_v4l2("0", options.capture, driver); },
      options, FirstOpening::Once);
  const double origin_s = source.stamp_origin_s();
  measure("camera: (V4L2, the tests' driver)", source, [&](const Frame& frame, double now_s) {
    return 1e3 * (now_s - origin_s - frame.stamp_s);
  });
}

}  // namespace
}  // namespace kestrel

int main() {
  using kestrel::test::free_port;
  kestrel::measure_v4l2();
  const std::string host = "127.0.0.1:";
  const std::string http = "http://" + host + std::to_string(free_port()) + "/v";
  kestrel::measure_stream("http:// (MJPEG)", http, "-c:v mjpeg -q:v 3 -f mpjpeg -listen 1 " + http);
  const std::string udp = "udp://" + host + std::to_string(free_port());
  kestrel::measure_stream("udp:// (MPEG-TS, MPEG-2)", udp,
                          "-c:v mpeg2video -q:v 2 -g 10 -bf 0 -f mpegts -flush_packets 1 "
                          "-muxdelay 0 -muxpreload 0 '" +
                              udp + "?pkt_size=1316'");
  const std::string rtp = "rtp://" + host + std::to_string(free_port());
  kestrel::measure_stream("rtp:// (MPEG-TS, MPEG-2)", rtp,
                          "-c:v mpeg2video -q:v 2 -g 10 -bf 0 -muxdelay 0 -f rtp_mpegts " + rtp);
  const std::string h264 = "udp://" + host + std::to_string(free_port());
  kestrel::measure_stream("udp:// (MPEG-TS, H.264 zero latency)", h264,
                          "-c:v libx264 -preset ultrafast -tune zerolatency -g 10 -f mpegts "
                          "-flush_packets 1 -muxdelay 0 '" +
                              h264 + "?pkt_size=1316'");
  return 0;
}

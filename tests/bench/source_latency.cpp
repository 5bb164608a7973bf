// How old a picture is when its command is decided, by source. A sender draws the time into each
// picture as black and white bars; the frame that comes out of the source says so when it was
// drawn, whatever stamps say. FFmpeg encodes and sends; V4L2 and FireWire are the tests' stand-ins,
// whose pictures were captured when their stamp says; pictures of files were captured long ago, so
// theirs is the time from asking for one. The times are the machine's: read them beside each other.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <opencv2/core.hpp>

#include "kestrel/io/live_camera.hpp"
#include "kestrel/io/sequence_recorder.hpp"
#include "kestrel/io/v4l2_camera.hpp"
#include "kestrel/link/autopilot_link.hpp"
#include "kestrel/link/frame_reader.hpp"
#include "kestrel/link/frame_server.hpp"
#include "kestrel/sim/texture.hpp"

#include "cli/rtsp_server.hpp"
#include "cli/video_sender.hpp"
#include "io/v4l2_standin.hpp"
#include "latency_chain.hpp"
#include "stamped_picture.hpp"
#include "stamped_sender.hpp"
#include "support/temp_folder.hpp"

extern "C" void kestrel_dc1394_show(const unsigned char* pixels, int period_ms);

namespace kestrel {
namespace {

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

/// A frame of a size that FireWire has, the poster where the chain looks for it.
void measure_dc1394() {
  const cv::Mat small = stamped(poster(120, 120, 7), 0);
  cv::Mat picture(480, 640, CV_8UC1, cv::Scalar(128));
  small.copyTo(picture(cv::Rect(0, 0, small.cols, small.rows)));
  kestrel_dc1394_show(picture.data, kPeriod_ms);
  const auto source = open_live("dc1394", {});
  const double origin_s = source->stamp_origin_s();
  measure("dc1394: (the tests' library)", *source, [&](const Frame& frame, double now_s) {
    return 1e3 * (now_s - origin_s - frame.stamp_s);
  });
}

/// What `sim:` reads, as the program's camera of it does: frames on a local socket.
class SimulatedDevice : public CameraDevice {
 public:
  explicit SimulatedDevice(const FramePlace& place) : reader_(place) {}
  std::optional<Picture> next() override {
    const auto frame = reader_.next(0.1);
    if (!frame) return std::nullopt;
    cv::Mat gray(int(frame->header.height_px), int(frame->header.width_px), CV_8U);
    std::copy(frame->pixels.begin(), frame->pixels.end(), gray.data);
    return Picture{gray, frame->capture_s, 0, ""};
  }
  CaptureClock clock() const override { return CaptureClock::Driver; }

 private:
  FrameReader reader_;
};

void measure_sim(const std::filesystem::path& folder) {
  const FramePlace place = parse_frame_place((folder / "frames").string());
  std::atomic<bool> stop{false};
  std::thread sender([&] {
    FrameServer server(place);
    const cv::Mat picture = poster(120, 120, 7);
    for (std::uint64_t number = 0; !stop; ++number) {
      const double now_s = link_clock_s();
      const cv::Mat now = stamped(picture, monotonic_clock_s());
      const FrameHeader header{std::uint32_t(now.cols), std::uint32_t(now.rows), number, now_s, 0};
      server.publish(header, {now.data, header.pixels()});
      while (link_clock_s() < now_s + 1e-3 * kPeriod_ms) server.serve(0.002);
    }
  });
  const OpenCamera open = [&](const StopAsked&, double) {
    return std::make_unique<SimulatedDevice>(place);
  };
  LiveSource source("sim:frames", open, {}, FirstOpening::Once);
  measure("sim: (a local socket)", source,
          [](const Frame& frame, double now_s) { return age_ms(frame.gray, now_s); });
  stop = true;
  sender.join();
}

/// The same pictures as files.
void measure_files(const std::filesystem::path& folder) {
  for (const char* output : {"pictures", "film.mp4"}) {
    SequenceRecorder recorder(folder / output, {"source_latency", {}}, 1e3 / kPeriod_ms);
    for (int i = 0; i < kPictures; ++i) {
      const double stamp_s = 1e-3 * kPeriod_ms * i;
      recorder.write(i, stamp_s, stamped(poster(120, 120, 7), stamp_s));
    }
    recorder.close();
  }
  measure_file("images:, sequence: (PNG)", (folder / "pictures/%06d.png").string());
  measure_file("video: (H.264)", (folder / "film.mp4").string());
}

/// What comes to a port as RTP, described by a file.
void measure_rtp_by_file(const std::filesystem::path& folder) {
  const int port = test::free_port();
  const auto file = folder / "stream.sdp";
  std::ofstream(file) << "v=0\r\no=- 0 0 IN IP4 127.0.0.1\r\ns=test\r\nc=IN IP4 127.0.0.1\r\n"
                         "t=0 0\r\nm=video "
                      << port << " RTP/AVP 96\r\na=rtpmap:96 H264/90000\r\n";
  measure_stream("rtp:FILE.sdp (H.264 zero latency)", "rtp:" + file.string(),
                 "-c:v libx264 -preset ultrafast -tune zerolatency -g 10 -bsf:v dump_extra "
                 "-sdp_file /dev/null -f rtp "
                 "rtp://127.0.0.1:" +
                     std::to_string(port));
}

void measure_rtsp() {
  const int port = test::free_port();
  const int feed = test::free_port();
  const test::RtspServer server(port, feed);
  measure_stream("rtsp:// (MPEG-TS, MPEG-2)", "rtsp://127.0.0.1:" + std::to_string(port) + "/video",
                 "-c:v mpeg2video -q:v 2 -g 10 -bf 0 -f mpegts -flush_packets 1 -muxdelay 0 "
                 "-muxpreload 0 'udp://127.0.0.1:" +
                     std::to_string(feed) + "?pkt_size=1316'");
}

}  // namespace
}  // namespace kestrel

int main() {
  using kestrel::test::free_port;
  const kestrel::test::TempFolder folder;
  kestrel::measure_v4l2();
  kestrel::measure_dc1394();
  kestrel::measure_sim(folder.path());
  kestrel::measure_files(folder.path());
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
  kestrel::measure_rtp_by_file(folder.path());
  kestrel::measure_rtsp();
  return 0;
}

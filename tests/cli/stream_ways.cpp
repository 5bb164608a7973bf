#include "cli/stream_ways.hpp"

#include "cli/mjpeg_page.hpp"
#include "cli/rtsp_server.hpp"
#include "cli/video_sender.hpp"

namespace kestrel::test {
namespace {

using Words = std::vector<std::string>;
using Sender = std::function<Command(int)>;

Sender ffmpeg(const Words& output) {
  return [output](int width) {
    return ffmpeg_command({test_picture(width, width * 3 / 4), output});
  };
}

/// GStreamer's moving test picture through the elements, which end at the network.
Sender gstreamer(const Words& elements) {
  return [elements](int width) {
    Command c{{"gst-launch-1.0", "-q", "videotestsrc", "is-live=true", "pattern=ball", "!",
               "video/x-raw,format=I420,framerate=25/1,width=" + std::to_string(width) +
                   ",height=" + std::to_string(width * 3 / 4)}};
    for (const std::string& element : elements) {
      c.words.emplace_back("!");
      std::size_t at = 0;
      while (at != std::string::npos) {
        const std::size_t space = element.find(' ', at);
        c.words.push_back(element.substr(at, space - at));
        at = space == std::string::npos ? space : space + 1;
      }
    }
    return c;
  };
}

Words to_port(Words elements, int port) {
  elements.push_back("udpsink host=127.0.0.1 port=" + std::to_string(port));
  return elements;
}

const Words kH264 = {"openh264enc gop-size=10", "h264parse config-interval=-1"};

Words with(Words elements, const Words& more) {
  elements.insert(elements.end(), more.begin(), more.end());
  return elements;
}

/// A description of what comes to a port, and its address as a source.
std::string rtp_by_file(const TempFolder& folder, int port, const std::string& media) {
  const std::string name = "stream" + std::to_string(port) + ".sdp";
  return "rtp:" + folder
                      .write(name,
                             "v=0\r\no=- 0 0 IN IP4 127.0.0.1\r\ns=test\r\nc=IN IP4 127.0.0.1\r\n"
                             "t=0 0\r\nm=video " +
                                 std::to_string(port) + " RTP/AVP " + media + "\r\n")
                      .string();
}

std::string host_port(int port) { return "127.0.0.1:" + std::to_string(port); }

std::function<std::shared_ptr<void>()> rtsp_server(int port, int feed) {
  return [=] { return std::make_shared<RtspServer>(port, feed); };
}

std::vector<StreamWay> ways_of_ffmpeg(const TempFolder& folder) {
  std::vector<StreamWay> all;
  const int udp = free_port();
  all.push_back({"FFmpeg udp, MPEG-TS", "udp://" + host_port(udp), ffmpeg(mpeg_over_udp(udp))});
  const std::string rtp = "rtp://" + host_port(free_port());
  all.push_back({"FFmpeg rtp, MPEG-TS", rtp,
                 ffmpeg({"-c:v", "mpeg2video", "-q:v", "2", "-g", "5", "-bf", "0", "-f",
                         "rtp_mpegts", rtp})});
  const int h264 = free_port();
  all.push_back({"FFmpeg rtp, H.264", rtp_by_file(folder, h264, "96\r\na=rtpmap:96 H264/90000"),
                 ffmpeg({"-c:v", "libx264", "-preset", "ultrafast", "-tune", "zerolatency", "-g",
                         "10", "-bsf:v", "dump_extra", "-f", "rtp", "rtp://" + host_port(h264)})});
  const std::string http = "http://" + host_port(free_port()) + "/video";
  all.push_back({"FFmpeg http, MJPEG", http,
                 ffmpeg({"-c:v", "mjpeg", "-q:v", "3", "-f", "mpjpeg", "-listen", "1", http})});
  all.back().serves_once = true;
  const int rtsp = free_port();
  const int feed = free_port();
  all.push_back({"FFmpeg rtsp, MPEG-TS", "rtsp://" + host_port(rtsp) + "/video",
                 ffmpeg(mpeg_over_udp(feed)), rtsp_server(rtsp, feed)});
  return all;
}

std::vector<StreamWay> ways_of_gstreamer(const TempFolder& folder) {
  std::vector<StreamWay> all;
  const Words ts = with(kH264, {"mpegtsmux alignment=7"});
  const int udp = free_port();
  all.push_back({"GStreamer udp, MPEG-TS", "udp://" + host_port(udp), gstreamer(to_port(ts, udp))});
  const int rtp = free_port();
  all.push_back({"GStreamer rtp, MPEG-TS", "rtp://" + host_port(rtp),
                 gstreamer(to_port(with(ts, {"rtpmp2tpay"}), rtp))});
  const int h264 = free_port();
  all.push_back({"GStreamer rtp, H.264", rtp_by_file(folder, h264, "96\r\na=rtpmap:96 H264/90000"),
                 gstreamer(to_port(with(kH264, {"rtph264pay config-interval=-1 pt=96"}), h264))});
  const int jpeg = free_port();
  all.push_back({"GStreamer rtp, MJPEG", rtp_by_file(folder, jpeg, "26"),
                 gstreamer(to_port({"jpegenc", "rtpjpegpay pt=26"}, jpeg))});
  const int page = free_port();
  const int body = free_port();
  all.push_back({"GStreamer http, MJPEG", "http://" + host_port(page) + "/video",
                 gstreamer({"jpegenc", "multipartmux boundary=picture",
                            "tcpclientsink host=127.0.0.1 port=" + std::to_string(body)}),
                 [=] { return std::make_shared<MjpegPage>(page, body, "picture"); }});
  const int rtsp = free_port();
  const int feed = free_port();
  all.push_back({"GStreamer rtsp, MPEG-TS", "rtsp://" + host_port(rtsp) + "/video",
                 gstreamer(to_port(ts, feed)), rtsp_server(rtsp, feed)});
  return all;
}

}  // namespace

std::vector<StreamWay> stream_ways(const TempFolder& folder) {
  std::vector<StreamWay> all = ways_of_ffmpeg(folder);
  for (StreamWay& way : ways_of_gstreamer(folder)) all.push_back(std::move(way));
  return all;
}

}  // namespace kestrel::test

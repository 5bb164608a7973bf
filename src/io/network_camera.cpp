#include "kestrel/io/network_camera.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "libav_decoder.hpp"

namespace kestrel {
namespace {

bool begins_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

/// What FFmpeg asks while it waits: whether to give up.
struct Patience {
  StopAsked stop;
  double until_s = 0;  // on the monotonic clock
  bool is_over() const { return stop() || monotonic_clock_s() >= until_s; }
  static int ask(void* self) { return static_cast<const Patience*>(self)->is_over() ? 1 : 0; }
};

std::string words_of(int error) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(error, text, sizeof text);
  return text;
}

/// Options of an input, freed with it.
struct Dictionary {
  AVDictionary* options = nullptr;
  Dictionary() = default;
  ~Dictionary() { av_dict_free(&options); }
  Dictionary(const Dictionary&) = delete;
  Dictionary& operator=(const Dictionary&) = delete;
  void set(const char* key, const char* value) { av_dict_set(&options, key, value, 0); }
};

/// What FFmpeg opens: for rtp:FILE.sdp the file.
std::string url_of(const std::string& address) {
  const bool is_file = begins_with(address, "rtp:") && !begins_with(address, "rtp://");
  return is_file ? "file:" + address.substr(4) : address;
}

/// The newest picture matters, not all of them: little is looked at before the first, nothing is
/// kept back for the order, and a full buffer loses its oldest instead of failing.
void prefer_new(Dictionary& d, const std::string& url) {
  d.set("analyzeduration", "1000000");  // us
  d.set("fpsprobesize", "0");           // the rate is not needed
  d.set("max_delay", "100000");         // us, for packets out of order
  d.set("overrun_nonfatal", "1");
  if (begins_with(url, "rtsp://")) d.set("rtsp_flags", "prefer_tcp");
  // Whoever answers may name further addresses: none of them may be a file.
  const bool is_file = begins_with(url, "file:");
  d.set("protocol_whitelist", is_file ? "file,rtp,udp" : "http,https,tls,tcp,udp,rtp,rtsp");
}

class NetworkCamera : public CameraDevice {
 public:
  NetworkCamera(std::string address, NetworkPatience patience, const StopAsked& stop)
      : address_(std::move(address)), stall_s_(patience.stall_timeout_s), patience_{stop, 0} {
    libav::be_silent();
    open(patience.open_timeout_s);
  }

  std::optional<Picture> next() override;
  CaptureClock clock() const override { return CaptureClock::Arrival; }

 private:
  void open(double timeout_s);
  AVFormatContext* opened(double timeout_s);
  bool receive();
  void feed();
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(address_ + ": " + what);
  }

  const std::string address_;
  const double stall_s_;
  Patience patience_;  // before input_, which asks it until it is closed
  libav::Input input_;
  AVStream* stream_ = nullptr;
  libav::Codec codec_;
  libav::Packet packet_{av_packet_alloc()};
  libav::Picture picture_{av_frame_alloc()};
  libav::GrayConverter converter_;
  double arrived_s_ = 0;  // the packet that was read last
  bool was_damaged_ = false;
};

AVFormatContext* NetworkCamera::opened(double timeout_s) {
  AVFormatContext* raw = avformat_alloc_context();
  if (raw == nullptr || !packet_ || !picture_) throw std::bad_alloc();
  raw->interrupt_callback = {Patience::ask, &patience_};
  const std::string url = url_of(address_);
  Dictionary options;
  prefer_new(options, url);
  const int error = avformat_open_input(&raw, url.c_str(), nullptr, &options.options);
  if (error >= 0) return raw;
  const bool timed_out = patience_.is_over();  // raw is freed by FFmpeg
  fail(fmt::format(
      "no video {}; check the address, and that the camera sends",
      timed_out ? fmt::format("within {:.3g} s", timeout_s) : "(" + words_of(error) + ")"));
}

void NetworkCamera::open(double timeout_s) {
  patience_.until_s = monotonic_clock_s() + timeout_s;
  input_.reset(opened(timeout_s));
  avformat_find_stream_info(input_.get(), nullptr);  // when it fails the decoder will say so
  stream_ = libav::video_stream(*input_);
  if (stream_ == nullptr && patience_.is_over()) {
    fail(fmt::format("no video within {:.3g} s; check the address, and that the camera sends",
                     timeout_s));
  }
  if (stream_ == nullptr) fail("what comes is no video; check the address");
  codec_ = libav::open_decoder(*stream_, libav::Delay::None);
  if (!codec_) fail("FFmpeg has no decoder for this video; let the camera send H.264 or MJPEG");
}

/// Hands the next piece of the stream to the decoder.
void NetworkCamera::feed() {
  int read = AVERROR(EAGAIN);
  do {
    av_packet_unref(packet_.get());
    read = av_read_frame(input_.get(), packet_.get());
    if (patience_.is_over()) return;
  } while (read == AVERROR(EAGAIN) || (read >= 0 && packet_->stream_index != stream_->index));
  if (read < 0) fail("the stream ended (" + words_of(read) + "); check the camera");
  arrived_s_ = monotonic_clock_s();
  const int sent = avcodec_send_packet(codec_.get(), packet_.get());
  if (sent < 0 && sent != AVERROR(EAGAIN)) was_damaged_ = true;
}

/// True with the next picture in picture_; false when the patience is over.
bool NetworkCamera::receive() {
  while (!patience_.is_over() && !was_damaged_) {
    const int got = avcodec_receive_frame(codec_.get(), picture_.get());
    if (got >= 0) return true;
    if (got == AVERROR(EAGAIN)) {
      feed();
    } else {
      was_damaged_ = true;
    }
  }
  return false;
}

std::optional<Picture> NetworkCamera::next() {
  patience_.until_s = monotonic_clock_s() + stall_s_;
  const bool received = receive();
  if (was_damaged_) {
    was_damaged_ = false;
    return Picture{cv::Mat(), monotonic_clock_s(), 0, "came damaged"};
  }
  if (patience_.stop()) return std::nullopt;
  if (!received)
    fail(fmt::format("no picture for {} s; check the camera and its connection", stall_s_));
  Picture out{converter_.gray(*picture_, *stream_), arrived_s_, 0, ""};
  const bool is_broken =
      (picture_->flags & AV_FRAME_FLAG_CORRUPT) != 0 || picture_->decode_error_flags != 0;
  if (is_broken || out.gray.empty()) out = {cv::Mat(), arrived_s_, 0, "came damaged"};
  return out;
}

}  // namespace

std::unique_ptr<CameraDevice> open_network(const std::string& address, NetworkPatience patience,
                                           const StopAsked& stop) {
  return std::make_unique<NetworkCamera>(address, patience, stop);
}

}  // namespace kestrel

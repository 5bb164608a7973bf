#include "kestrel/io/video_reader.hpp"

#include <cmath>
#include <stdexcept>

#include "libav_decoder.hpp"

namespace kestrel {
namespace {

constexpr int kMostErrors = 512;  // in a row; then the rest of the file counts as lost

/// The opened file; null for what is no video. "file:" keeps a colon in the path from being read as
/// a protocol.
libav::Input open_input(const std::string& path) {
  AVFormatContext* raw = nullptr;
  if (avformat_open_input(&raw, ("file:" + path).c_str(), nullptr, nullptr) < 0) return nullptr;
  libav::Input input(raw);
  return avformat_find_stream_info(raw, nullptr) < 0 ? nullptr : std::move(input);
}

}  // namespace

struct VideoReader::Decoder {
  libav::Input input;
  AVStream* stream = nullptr;
  libav::Codec codec;
  libav::Packet packet{av_packet_alloc()};
  libav::Picture picture{av_frame_alloc()};
  libav::GrayConverter converter;
  std::optional<std::int64_t> start;  // time stamp of the first picture
  std::int64_t pictures = 0;
  std::int64_t damaged = 0;

  bool open(const std::string& path);
  bool decode();
  void feed();
  cv::Mat gray();
};

bool VideoReader::Decoder::open(const std::string& path) {
  input = open_input(path);
  stream = input ? libav::video_stream(*input) : nullptr;
  if (stream != nullptr) codec = libav::open_decoder(*stream, libav::Delay::AsNeeded);
  return codec && packet && picture;
}

/// Hands the next piece of the stream to the decoder, or that the file has ended.
void VideoReader::Decoder::feed() {
  int read = AVERROR(EAGAIN);
  do {
    av_packet_unref(packet.get());
    read = av_read_frame(input.get(), packet.get());
  } while (read == AVERROR(EAGAIN) || (read >= 0 && packet->stream_index != stream->index));
  const int sent = avcodec_send_packet(codec.get(), read < 0 ? nullptr : packet.get());
  if (sent < 0 && sent != AVERROR_EOF) ++damaged;
}

/// The next picture into `picture`; false at the end.
bool VideoReader::Decoder::decode() {
  for (const std::int64_t most = damaged + kMostErrors; damaged < most;) {
    const int got = avcodec_receive_frame(codec.get(), picture.get());
    if (got >= 0) {
      if (pictures++ == 0 && picture->best_effort_timestamp != AV_NOPTS_VALUE)
        start = picture->best_effort_timestamp;
      return true;
    }
    if (got == AVERROR_EOF) return false;
    if (got != AVERROR(EAGAIN)) ++damaged;
    feed();
  }
  return false;
}

/// The decoded picture in grey; empty when it cannot be converted.
cv::Mat VideoReader::Decoder::gray() { return converter.gray(*picture, *stream); }

VideoReader::VideoReader(const std::filesystem::path& path)
    : decoder_(std::make_unique<Decoder>()) {
  libav::be_silent();
  if (!decoder_->open(path.string()))
    throw std::runtime_error(path.string() + ": is no video that FFmpeg can read; re-encode it");
}

VideoReader::~VideoReader() = default;

bool VideoReader::skip() { return decoder_->decode(); }

std::optional<VideoPicture> VideoReader::next() {
  if (!decoder_->decode()) return std::nullopt;
  VideoPicture out{decoder_->gray(), std::nullopt};
  if (out.gray.empty()) return std::nullopt;
  const std::int64_t stamp = decoder_->picture->best_effort_timestamp;
  const AVRational base = decoder_->stream->time_base;
  if (decoder_->start && stamp != AV_NOPTS_VALUE)
    out.time_s = double((stamp - *decoder_->start) * base.num) / base.den;
  return out;
}

std::optional<double> VideoReader::rate_hz() const {
  const AVRational rate = av_guess_frame_rate(decoder_->input.get(), decoder_->stream, nullptr);
  const double hz = rate.den > 0 ? av_q2d(rate) : 0;
  return hz > 0 && hz < 10000 ? std::optional(hz) : std::nullopt;
}

std::int64_t VideoReader::promised() const {
  const AVStream& stream = *decoder_->stream;
  if (stream.nb_frames > 0) return stream.nb_frames;
  double duration_s = double(decoder_->input->duration) / AV_TIME_BASE;
  if (!(duration_s > 0)) duration_s = double(stream.duration) * av_q2d(stream.time_base);
  const double frames = duration_s * rate_hz().value_or(0);
  return frames > 0 && frames < 1e15 ? std::int64_t(std::floor(frames + 0.5)) : 0;
}

std::int64_t VideoReader::damaged() const { return decoder_->damaged; }

}  // namespace kestrel

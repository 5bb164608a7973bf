#include "kestrel/io/video_reader.hpp"

#include <cmath>
#include <stdexcept>

#include <opencv2/core.hpp>

#include "kestrel/io/gray_image.hpp"

#include "libav.hpp"

extern "C" {
#include <libavutil/display.h>
}

namespace kestrel {
namespace {

constexpr int kMostErrors = 512;  // in a row; then the rest of the file counts as lost

struct CloseInput {
  void operator()(AVFormatContext* input) const { avformat_close_input(&input); }
};
using Input = std::unique_ptr<AVFormatContext, CloseInput>;

/// The opened file; null for what is no video. "file:" keeps a colon in the path from being read as
/// a protocol.
Input open_input(const std::string& path) {
  AVFormatContext* raw = nullptr;
  if (avformat_open_input(&raw, ("file:" + path).c_str(), nullptr, nullptr) < 0) return nullptr;
  Input input(raw);
  return avformat_find_stream_info(raw, nullptr) < 0 ? nullptr : std::move(input);
}

/// The first video stream that is no cover picture; null when there is none.
AVStream* video_stream(const AVFormatContext& input) {
  for (unsigned i = 0; i < input.nb_streams; ++i) {
    AVStream* const stream = input.streams[i];
    const bool is_cover = (stream->disposition & AV_DISPOSITION_ATTACHED_PIC) != 0;
    if (stream->codecpar->codec_type == AVMEDIA_TYPE_VIDEO && !is_cover) return stream;
  }
  return nullptr;
}

/// The opened decoder; null when there is none.
libav::Codec open_decoder(const AVStream& stream) {
  const AVCodec* const kind = avcodec_find_decoder(stream.codecpar->codec_id);
  libav::Codec codec(kind == nullptr ? nullptr : avcodec_alloc_context3(kind));
  if (!codec || avcodec_parameters_to_context(codec.get(), stream.codecpar) < 0) return nullptr;
  codec->pkt_timebase = stream.time_base;
  codec->thread_count = 1;    // each further one holds more pictures
  codec->apply_cropping = 0;  // cropped here, after the conversion, as OpenCV does
  return avcodec_open2(codec.get(), kind, nullptr) < 0 ? nullptr : std::move(codec);
}

/// By how many degrees clockwise the file wants its pictures turned: 0, 90, 180 or 270.
int rotation_deg(const AVStream& stream) {
  const std::uint8_t* const matrix =
      av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
  if (matrix == nullptr) return 0;
  const double angle = av_display_rotation_get(reinterpret_cast<const std::int32_t*>(matrix));
  const int clockwise = std::isfinite(angle) ? -int(std::lround(angle)) : 0;
  return (clockwise + 360) % 360;
}

cv::Mat turned(const cv::Mat& image, int clockwise_deg) {
  cv::Mat out = image;
  if (clockwise_deg == 90) cv::rotate(image, out, cv::ROTATE_90_CLOCKWISE);
  if (clockwise_deg == 180) cv::rotate(image, out, cv::ROTATE_180);
  if (clockwise_deg == 270) cv::rotate(image, out, cv::ROTATE_90_COUNTERCLOCKWISE);
  return out;
}

}  // namespace

struct VideoReader::Decoder {
  Input input;
  AVStream* stream = nullptr;
  libav::Codec codec;
  libav::Packet packet{av_packet_alloc()};
  libav::Picture picture{av_frame_alloc()};
  libav::Picture bgr;
  libav::Scaler scaler;
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
  stream = input ? video_stream(*input) : nullptr;
  if (stream != nullptr) codec = open_decoder(*stream);
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
cv::Mat VideoReader::Decoder::gray() {
  const AVFrame& from = *picture;
  if (!bgr || bgr->width != from.width || bgr->height != from.height)
    bgr = libav::new_picture(from.width, from.height, AV_PIX_FMT_BGR24);
  if (!libav::convert(scaler, from, *bgr)) return {};
  const cv::Mat whole(bgr->height, bgr->width, CV_8UC3, bgr->data[0],
                      std::size_t(bgr->linesize[0]));
  const cv::Rect visible(int(from.crop_left), int(from.crop_top),
                         from.width - int(from.crop_left + from.crop_right),
                         from.height - int(from.crop_top + from.crop_bottom));
  return turned(as_gray(whole(visible)), rotation_deg(*stream));
}

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

#include "video_encoder.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <opencv2/core.hpp>

#include "libav.hpp"

extern "C" {
#include <libavutil/opt.h>
}

namespace kestrel {
namespace {

namespace fs = std::filesystem;

constexpr int kTicks_hz = 90000;  // of MPEG: any usual rate is a whole number of them

const AVCodec* encoder_of(VideoKind kind) {
  return avcodec_find_encoder(kind == VideoKind::H264 ? AV_CODEC_ID_H264 : AV_CODEC_ID_MJPEG);
}

/// Closes the file below a container, then frees the container.
struct CloseOutput {
  void operator()(AVFormatContext* output) const {
    avio_closep(&output->pb);
    avformat_free_context(output);
  }
};
using Output = std::unique_ptr<AVFormatContext, CloseOutput>;

/// One thread, no pictures predicted from later ones, and x264's quicker search with its shorter
/// look ahead: a third of the memory of its defaults for a file of the same size. Other H.264
/// encoders do not know these words and leave them.
void keep_small(AVCodecContext& codec) {
  codec.thread_count = 1;
  codec.max_b_frames = 0;
  av_opt_set(codec.priv_data, "preset", "veryfast", 0);
  av_opt_set(codec.priv_data, "crf", "23", 0);
}

libav::Codec open_encoder(VideoKind kind, const cv::Size& size, double frames_per_s,
                          VideoTimes times, bool wants_global_header) {
  const AVCodec* const encoder = encoder_of(kind);
  libav::Codec codec(encoder == nullptr ? nullptr : avcodec_alloc_context3(encoder));
  if (!codec) return nullptr;
  constexpr int kFinestRate = 100000;  // the largest denominator of a rate
  codec->framerate = av_d2q(frames_per_s, kFinestRate);
  codec->time_base =
      times == VideoTimes::Steady ? av_inv_q(codec->framerate) : AVRational{1, kTicks_hz};
  codec->width = size.width;
  codec->height = size.height;
  if (wants_global_header) codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  if (kind == VideoKind::H264) {
    codec->pix_fmt = AV_PIX_FMT_YUV420P;
    keep_small(*codec);
  } else {
    codec->pix_fmt = AV_PIX_FMT_YUVJ420P;
    codec->thread_count = 1;
    codec->flags |= AV_CODEC_FLAG_QSCALE;
    codec->global_quality = 3 * FF_QP2LAMBDA;  // about quality 90 of a JPEG
  }
  return avcodec_open2(codec.get(), encoder, nullptr) < 0 ? nullptr : std::move(codec);
}

/// A container of this kind without streams or file; null when FFmpeg has none.
Output new_output(VideoKind kind) {
  AVFormatContext* raw = nullptr;
  const char* const container = kind == VideoKind::H264 ? "mp4" : "avi";
  avformat_alloc_output_context2(&raw, nullptr, container, nullptr);
  return Output(raw);
}

}  // namespace

struct VideoEncoder::File {
  fs::path path;
  Output output;
  AVStream* stream = nullptr;
  libav::Codec codec;
  libav::Packet packet{av_packet_alloc()};
  libav::Picture picture;
  libav::Scaler scaler;
  std::int64_t last = -1;  // time of the last picture, in the codec's time base
  bool is_whole = true;

  VideoTimes times = VideoTimes::Steady;
  std::int64_t ticks_of(double time_s) const;

  bool begin();
  void encode(const AVFrame* next);
};

/// Hands a picture to the encoder (null: there are no more) and what comes out to the file.
void VideoEncoder::File::encode(const AVFrame* next) {
  if (avcodec_send_frame(codec.get(), next) < 0) is_whole = false;
  while (is_whole && avcodec_receive_packet(codec.get(), packet.get()) >= 0) {
    if (packet->duration == 0)
      packet->duration = av_rescale_q(1, av_inv_q(codec->framerate), codec->time_base);
    av_packet_rescale_ts(packet.get(), codec->time_base, stream->time_base);
    packet->stream_index = stream->index;
    if (av_interleaved_write_frame(output.get(), packet.get()) < 0) is_whole = false;
  }
}

std::int64_t VideoEncoder::File::ticks_of(double time_s) const {
  if (times == VideoTimes::Steady) return last + 1;
  return std::llround(time_s * codec->time_base.den / codec->time_base.num);
}

/// Creates the file and writes its head; false when that fails.
bool VideoEncoder::File::begin() {
  const std::string url = "file:" + path.string();
  if (avio_open(&output->pb, url.c_str(), AVIO_FLAG_WRITE) < 0) return false;
  return avformat_write_header(output.get(), nullptr) >= 0;
}

std::unique_ptr<VideoEncoder> VideoEncoder::open(const fs::path& path, VideoKind kind,
                                                 const cv::Size& size, double frames_per_s,
                                                 VideoTimes times) {
  libav::be_silent();
  auto s = std::make_unique<File>();
  s->path = path;
  s->times = times;
  s->output = new_output(kind);
  if (!s->output) return nullptr;
  const bool wants_global_header = (s->output->oformat->flags & AVFMT_GLOBALHEADER) != 0;
  s->codec = open_encoder(kind, size, frames_per_s, times, wants_global_header);
  s->stream = avformat_new_stream(s->output.get(), nullptr);
  if (!s->codec || s->stream == nullptr) return nullptr;
  s->stream->time_base = s->codec->time_base;
  s->stream->avg_frame_rate = s->codec->framerate;
  avcodec_parameters_from_context(s->stream->codecpar, s->codec.get());
  s->picture = libav::new_picture(size.width, size.height, s->codec->pix_fmt);
  if (!s->begin()) throw std::runtime_error(path.string() + ": the video cannot be created");
  return std::unique_ptr<VideoEncoder>(new VideoEncoder(std::move(s)));
}

VideoEncoder::VideoEncoder(std::unique_ptr<File> file) : file_(std::move(file)) {}

VideoEncoder::~VideoEncoder() = default;

bool VideoEncoder::is_whole() const { return file_->is_whole; }

void VideoEncoder::write(const cv::Mat& bgr, double time_s) {
  File& s = *file_;
  if (!s.is_whole || av_frame_make_writable(s.picture.get()) < 0) return;
  libav::Picture from(av_frame_alloc());
  from->width = bgr.cols;
  from->height = bgr.rows;
  from->format = AV_PIX_FMT_BGR24;
  from->data[0] = const_cast<unsigned char*>(bgr.data);
  from->linesize[0] = int(bgr.step);
  s.is_whole = libav::convert(s.scaler, *from, *s.picture);
  s.last = std::max(s.last + 1, s.ticks_of(time_s));
  s.picture->pts = s.last;
  if (s.is_whole) s.encode(s.picture.get());
}

bool VideoEncoder::finish() {
  File& s = *file_;
  if (s.is_whole) s.encode(nullptr);
  if (av_write_trailer(s.output.get()) < 0) s.is_whole = false;
  avio_flush(s.output->pb);
  const std::int64_t bytes = avio_size(s.output->pb);  // not where it stands: AVI goes back
  if (s.output->pb->error < 0 || avio_closep(&s.output->pb) < 0) s.is_whole = false;
  std::error_code error;
  const auto stored = fs::file_size(s.path, error);
  return s.is_whole && !error && std::int64_t(stored) == bytes;
}

}  // namespace kestrel

#include "libav_decoder.hpp"

#include <cmath>

#include <opencv2/core.hpp>

#include "kestrel/io/gray_image.hpp"

extern "C" {
#include <libavutil/display.h>
}

namespace kestrel::libav {
namespace {

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

AVStream* video_stream(const AVFormatContext& input) {
  for (unsigned i = 0; i < input.nb_streams; ++i) {
    AVStream* const stream = input.streams[i];
    const bool is_cover = (stream->disposition & AV_DISPOSITION_ATTACHED_PIC) != 0;
    if (stream->codecpar->codec_type == AVMEDIA_TYPE_VIDEO && !is_cover) return stream;
  }
  return nullptr;
}

Codec open_decoder(const AVStream& stream, Delay delay) {
  const AVCodec* const kind = avcodec_find_decoder(stream.codecpar->codec_id);
  Codec codec(kind == nullptr ? nullptr : avcodec_alloc_context3(kind));
  if (!codec || avcodec_parameters_to_context(codec.get(), stream.codecpar) < 0) return nullptr;
  codec->pkt_timebase = stream.time_base;
  codec->thread_count = 1;    // each further one holds more pictures
  codec->apply_cropping = 0;  // cropped here, after the conversion, as OpenCV does
  if (delay == Delay::None) codec->flags |= AV_CODEC_FLAG_LOW_DELAY;
  return avcodec_open2(codec.get(), kind, nullptr) < 0 ? nullptr : std::move(codec);
}

cv::Mat GrayConverter::gray(const AVFrame& from, const AVStream& stream) {
  if (!bgr_ || bgr_->width != from.width || bgr_->height != from.height)
    bgr_ = new_picture(from.width, from.height, AV_PIX_FMT_BGR24);
  if (!convert(scaler_, from, *bgr_)) return {};
  const cv::Mat whole(bgr_->height, bgr_->width, CV_8UC3, bgr_->data[0],
                      std::size_t(bgr_->linesize[0]));
  const cv::Rect visible(int(from.crop_left), int(from.crop_top),
                         from.width - int(from.crop_left + from.crop_right),
                         from.height - int(from.crop_top + from.crop_bottom));
  return turned(as_gray(whole(visible)), rotation_deg(stream));
}

}  // namespace kestrel::libav

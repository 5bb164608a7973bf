#include "libav.hpp"

#include <new>

namespace kestrel::libav {

Picture new_picture(int width, int height, AVPixelFormat format) {
  constexpr int kRowAlignment = 32;
  Picture picture(av_frame_alloc());
  if (!picture) throw std::bad_alloc();
  picture->width = width;
  picture->height = height;
  picture->format = format;
  if (av_frame_get_buffer(picture.get(), kRowAlignment) < 0) throw std::bad_alloc();
  return picture;
}

bool convert(Scaler& scaler, const AVFrame& from, AVFrame& to) {
  scaler.reset(sws_getCachedContext(
      scaler.release(), from.width, from.height, AVPixelFormat(from.format), to.width, to.height,
      AVPixelFormat(to.format), SWS_BICUBIC, nullptr, nullptr, nullptr));
  return scaler && sws_scale(scaler.get(), from.data, from.linesize, 0, from.height, to.data,
                             to.linesize) == to.height;
}

void be_silent() { av_log_set_level(AV_LOG_QUIET); }

}  // namespace kestrel::libav

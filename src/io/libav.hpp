#pragma once

#include <memory>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

namespace kestrel::libav {

/// Releases with the libraries' own functions.
struct Release {
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};

using Codec = std::unique_ptr<AVCodecContext, Release>;
using Picture = std::unique_ptr<AVFrame, Release>;
using Packet = std::unique_ptr<AVPacket, Release>;
using Scaler = std::unique_ptr<SwsContext, Release>;

/// A picture with room for pixels, its rows on multiples of 32 bytes. Throws std::bad_alloc.
Picture new_picture(int width, int height, AVPixelFormat format);

/// Converts all of `from` into `to`, of the same size, as OpenCV does (SWS_BICUBIC, which is how
/// chroma is enlarged); false when the formats do not allow it. The scaler is made when first
/// needed and again when the size or format changes.
bool convert(Scaler& scaler, const AVFrame& from, AVFrame& to);

/// Keeps the libraries from printing: what is wrong is said by exceptions.
void be_silent();

}  // namespace kestrel::libav

#pragma once

#include <memory>

#include <opencv2/core/mat.hpp>

#include "libav.hpp"

namespace kestrel::libav {

struct CloseInput {
  void operator()(AVFormatContext* input) const { avformat_close_input(&input); }
};
using Input = std::unique_ptr<AVFormatContext, CloseInput>;

/// The first video stream that is no cover picture; null when there is none.
AVStream* video_stream(const AVFormatContext& input);

/// Whether a decoder may keep pictures back.
enum class Delay {
  AsNeeded,  // those that show later than they come get their place
  None,      // each picture at once, as cameras send them
};

/// The opened decoder, of one thread; null when there is none.
Codec open_decoder(const AVStream& stream, Delay delay);

/// Turns decoded pictures into grey ones as cv::VideoCapture and as_gray do: the same conversion to
/// BGR, then OpenCV's luma.
class GrayConverter {
 public:
  /// 8-bit, cropped and turned upright as the stream asks for; empty when it cannot be converted.
  cv::Mat gray(const AVFrame& from, const AVStream& stream);

 private:
  Picture bgr_;
  Scaler scaler_;
};

}  // namespace kestrel::libav

#pragma once

#include <functional>
#include <string>

#include <opencv2/core/mat.hpp>

namespace kestrel {

/// What kestrel_capture.so gives: OpenCV's cameras and network streams, behind which stand half a
/// hundred libraries.
struct CaptureModule {
  /// The next image, BGR; empty at the end.
  using Images = std::function<cv::Mat()>;

  /// The V4L2 device of this number; an empty function when it does not open.
  Images (*open_device)(int number);
  /// A stream that FFmpeg reads; an empty function when nothing comes in time.
  Images (*open_stream)(const std::string& address, int open_timeout_ms, int read_timeout_ms);
};

}  // namespace kestrel

#include "capture_module.hpp"

#include <opencv2/videoio.hpp>

namespace kestrel {
namespace {

CaptureModule::Images images_of(const cv::VideoCapture& opened) {
  if (!opened.isOpened()) return {};
  return [capture = opened]() mutable {
    cv::Mat image;
    if (!capture.read(image)) image.release();
    return image;
  };
}

CaptureModule::Images open_device(int number) {
  return images_of(cv::VideoCapture(number, cv::CAP_V4L2));
}

CaptureModule::Images open_stream(const std::string& address, int open_timeout_ms,
                                  int read_timeout_ms) {
  return images_of(cv::VideoCapture(address, cv::CAP_FFMPEG,
                                    {cv::CAP_PROP_OPEN_TIMEOUT_MSEC, open_timeout_ms,
                                     cv::CAP_PROP_READ_TIMEOUT_MSEC, read_timeout_ms}));
}

}  // namespace

extern "C" const CaptureModule kKestrelModule;
const CaptureModule kKestrelModule{open_device, open_stream};

}  // namespace kestrel

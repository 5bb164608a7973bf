#include "kestrel/io/raw_picture.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "kestrel/io/gray_image.hpp"
#include "kestrel/io/image_codec.hpp"

namespace kestrel {
namespace {

/// Bytes of a pixel in the first plane; 0 for what has none.
std::size_t pixel_bytes(RawFormat format) {
  switch (format) {
    case RawFormat::Grey:
    case RawFormat::Nv12:
    case RawFormat::Yuv420:
      return 1;
    case RawFormat::Yuyv:
    case RawFormat::Uyvy:
      return 2;
    case RawFormat::Bgr24:
    case RawFormat::Rgb24:
      return 3;
    case RawFormat::Mjpeg:
      break;
  }
  return 0;
}

cv::Mat gray_of_jpeg(const RawBytes& bytes, cv::Size size) {
  const cv::Mat gray = as_gray(decode_image({bytes.data, bytes.data + bytes.count}));
  return gray.size() == size ? gray : cv::Mat();
}

}  // namespace

const std::vector<RawFormat>& raw_formats() {
  static const std::vector<RawFormat> all = {RawFormat::Grey,  RawFormat::Nv12, RawFormat::Yuv420,
                                             RawFormat::Yuyv,  RawFormat::Uyvy, RawFormat::Bgr24,
                                             RawFormat::Rgb24, RawFormat::Mjpeg};
  return all;
}

const char* name(RawFormat format) {
  switch (format) {
    case RawFormat::Grey:
      return "grey";
    case RawFormat::Nv12:
      return "nv12";
    case RawFormat::Yuv420:
      return "yuv420";
    case RawFormat::Yuyv:
      return "yuyv";
    case RawFormat::Uyvy:
      return "uyvy";
    case RawFormat::Bgr24:
      return "bgr24";
    case RawFormat::Rgb24:
      return "rgb24";
    case RawFormat::Mjpeg:
      return "mjpeg";
  }
  return "unknown";
}

std::optional<RawFormat> raw_format_named(const std::string& word) {
  for (const RawFormat format : raw_formats()) {
    if (word == name(format)) return format;
  }
  return std::nullopt;
}

cv::Mat gray_of(RawFormat format, const RawBytes& bytes, cv::Size size) {
  if (bytes.data == nullptr || size.empty()) return {};
  if (format == RawFormat::Mjpeg) return gray_of_jpeg(bytes, size);
  const std::size_t row = pixel_bytes(format) * std::size_t(size.width);
  const std::size_t step = bytes.row_bytes == 0 ? row : bytes.row_bytes;
  if (step < row || bytes.count < step * std::size_t(size.height - 1) + row) return {};
  auto* const data = const_cast<unsigned char*>(bytes.data);  // cv::Mat knows no constant pixels
  const cv::Mat plane(size, CV_8UC(int(pixel_bytes(format))), data, step);
  cv::Mat gray;
  if (format == RawFormat::Yuyv) {
    cv::extractChannel(plane, gray, 0);
  } else if (format == RawFormat::Uyvy) {
    cv::extractChannel(plane, gray, 1);
  } else if (format == RawFormat::Rgb24) {
    cv::cvtColor(plane, gray, cv::COLOR_RGB2GRAY);
  } else if (format == RawFormat::Bgr24) {
    cv::cvtColor(plane, gray, cv::COLOR_BGR2GRAY);
  } else {
    gray = plane.clone();
  }
  return gray;
}

}  // namespace kestrel

#include "dc1394_picture.hpp"

#include <algorithm>
#include <cstring>

#include <opencv2/core.hpp>

#include "kestrel/io/raw_picture.hpp"

namespace kestrel::iidc {
namespace {

cv::Size size_of(const dc1394video_frame_t& frame) {
  return {int(frame.size[0]), int(frame.size[1])};
}

/// The picture's bytes, not copied; valid as long as the frame is.
cv::Mat plane(const dc1394video_frame_t& frame, int type) {
  return cv::Mat(size_of(frame), type, frame.image, frame.stride);
}

/// Of 16 bits the upper eight of those in use (IIDC: in the lower ones, the upper byte first).
cv::Mat narrowed(const dc1394video_frame_t& frame, int channels) {
  const int bits = std::clamp(int(frame.data_depth), 8, 16);
  const cv::Mat wide = plane(frame, CV_8UC(2 * channels));
  cv::Mat narrow(wide.size(), CV_8UC(channels));
  const int high = frame.little_endian == DC1394_TRUE ? 1 : 0;
  for (int row = 0; row < wide.rows; ++row) {
    const uchar* from = wide.ptr(row);
    uchar* to = narrow.ptr(row);
    for (int i = 0; i < wide.cols * channels; ++i) {
      const int value = from[2 * i + high] << 8 | from[2 * i + 1 - high];
      to[i] = cv::saturate_cast<uchar>(value >> (bits - 8));
    }
  }
  return narrow;
}

/// The Y of YUV 4:1:1: of four pixels U Y0 Y1 V Y2 Y3.
cv::Mat brightness_of_411(const dc1394video_frame_t& frame) {
  cv::Mat gray(size_of(frame), CV_8UC1);
  for (int row = 0; row < gray.rows; ++row) {
    const uchar* from = frame.image + std::size_t(row) * frame.stride;
    uchar* to = gray.ptr(row);
    for (int i = 0; i + 3 < gray.cols; i += 4, from += 6, to += 4) {
      to[0] = from[1];
      to[1] = from[2];
      to[2] = from[4];
      to[3] = from[5];
    }
  }
  return gray;
}

cv::Mat luma(const cv::Mat& rgb) {
  return kestrel::gray_of(RawFormat::Rgb24, {rgb.data, rgb.step * std::size_t(rgb.rows), rgb.step},
                          rgb.size());
}

cv::Mat decoded(const cv::Mat& raw, dc1394color_filter_t pattern) {
  const cv::Mat whole = raw.isContinuous() ? raw : raw.clone();  // the library knows no stride
  cv::Mat rgb(whole.size(), CV_8UC3);
  require(
      dc1394_bayer_decoding_8bit(whole.data, rgb.data, std::uint32_t(whole.cols),
                                 std::uint32_t(whole.rows), pattern, DC1394_BAYER_METHOD_BILINEAR),
      "decoding the pattern of its colours");
  return luma(rgb);
}

cv::Mat brightness_of_422(const dc1394video_frame_t& frame) {
  const bool y_first = frame.yuv_byte_order == DC1394_BYTE_ORDER_YUYV;
  return kestrel::gray_of(y_first ? RawFormat::Yuyv : RawFormat::Uyvy,
                          {frame.image, std::size_t(frame.stride) * frame.size[1], frame.stride},
                          size_of(frame));
}

}  // namespace

cv::Mat gray_of(const dc1394video_frame_t& frame, dc1394color_filter_t pattern) {
  switch (frame.color_coding) {
    case DC1394_COLOR_CODING_MONO8:
      return plane(frame, CV_8UC1).clone();
    case DC1394_COLOR_CODING_MONO16:
      return narrowed(frame, 1);
    case DC1394_COLOR_CODING_YUV411:
      return brightness_of_411(frame);
    case DC1394_COLOR_CODING_YUV422:
      return brightness_of_422(frame);
    case DC1394_COLOR_CODING_YUV444: {
      cv::Mat gray;
      cv::extractChannel(plane(frame, CV_8UC3), gray, 1);
      return gray;
    }
    case DC1394_COLOR_CODING_RGB8:
      return luma(plane(frame, CV_8UC3));
    case DC1394_COLOR_CODING_RGB16:
      return luma(narrowed(frame, 3));
    case DC1394_COLOR_CODING_RAW8:
      return decoded(plane(frame, CV_8UC1), pattern);
    case DC1394_COLOR_CODING_RAW16:
      return decoded(narrowed(frame, 1), pattern);
    default:
      fail("a frame came in a format that is not read");
  }
}

}  // namespace kestrel::iidc

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace kestrel {

/// How a camera lays out a picture in memory.
enum class RawFormat { Grey, Nv12, Yuv420, Yuyv, Uyvy, Bgr24, Rgb24, Mjpeg };

/// All of them, the best first: grey as it was measured, then brightness that was not compressed,
/// then colour, then JPEG.
const std::vector<RawFormat>& raw_formats();

/// "grey", "nv12", "yuv420", "yuyv", "uyvy", "bgr24", "rgb24", "mjpeg".
const char* name(RawFormat format);

/// The format of a name; empty for any other word.
std::optional<RawFormat> raw_format_named(const std::string& word);

/// Bytes in memory, not owned.
struct RawBytes {
  const unsigned char* data = nullptr;
  std::size_t count = 0;
  std::size_t row_bytes = 0;  // from one row to the next of the first plane; 0: no gap between them
};

/// The brightness of a picture, 8 bits, a copy of its own: the Y of YUV as the camera sends it,
/// OpenCV's luma of RGB. Empty for what is cut short or is no JPEG.
cv::Mat gray_of(RawFormat format, const RawBytes& bytes, cv::Size size);

}  // namespace kestrel

#pragma once

#include <optional>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace kestrel {

/// The most pixels that are read, as in OpenCV: a damaged header could ask for any number.
constexpr double kMostPixels = 1 << 30;

/// The image in the bytes of a PNG or JPEG file, as decode_image; absent for a kind that is left to
/// OpenCV: a palette, fewer than 8 bits, 16 bits in colour, four inks.
std::optional<cv::Mat> decode_png(const std::vector<unsigned char>& bytes);
std::optional<cv::Mat> decode_jpeg(const std::vector<unsigned char>& bytes);

}  // namespace kestrel

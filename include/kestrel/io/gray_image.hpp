#pragma once

#include <filesystem>

#include <opencv2/core/mat.hpp>

#include "kestrel/io/text_file.hpp"

namespace kestrel {

/// The image in a file, 8-bit grey: colour by OpenCV's luma, 16 bits divided by 257 (65535 becomes
/// 255), the pixels as stored (an orientation note is ignored: the calibration holds for the stored
/// ones). Throws FileError when the file is missing, no image, or cut short.
cv::Mat load_gray(const std::filesystem::path& file);

/// Writes an 8-bit grey picture as PNG, every pixel as it is. Throws std::runtime_error (path,
/// cause, remedy) when the disk does not take it, and leaves no half of it; std::invalid_argument
/// for another picture or an empty one.
void save_png(const std::filesystem::path& file, const cv::Mat& gray);

/// An image of a camera or video as 8-bit grey, by the same rules; empty for what is no image of 1,
/// 3 or 4 channels of 8 or 16 bits.
cv::Mat as_gray(const cv::Mat& image);

}  // namespace kestrel

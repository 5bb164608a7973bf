#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

namespace kestrel {

/// The image in the bytes of a file: grey, BGR or BGRA of 8 or 16 bits, the pixels as stored (an
/// orientation note is ignored); the same as cv::imdecode with IMREAD_UNCHANGED gives. Empty for
/// what is no image, is damaged or cut short. PNG, JPEG, PGM and PPM of the usual kinds are read by
/// their own libraries; everything else by OpenCV's, in the module `images`, loaded when it is
/// needed. Throws std::runtime_error when that cannot be loaded, cv::Exception when OpenCV refuses.
cv::Mat decode_image(const std::vector<unsigned char>& bytes);

/// A baseline JPEG file (colour 4:2:0) of an 8-bit grey or BGR picture that is not empty. quality:
/// 1 to 100. Throws std::invalid_argument for any other picture.
std::vector<unsigned char> encode_jpeg(const cv::Mat& picture, int quality);

/// A PNG file of an 8-bit grey picture, every pixel as it is. Throws std::invalid_argument for any
/// other picture or an empty one.
std::vector<unsigned char> encode_png(const cv::Mat& gray);

}  // namespace kestrel

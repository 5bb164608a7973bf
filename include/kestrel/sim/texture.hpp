#pragma once

#include <cstdint>

#include <opencv2/core/mat.hpp>

/// Pictures made by rule, so that a simulated world needs no files. The same arguments give the
/// same bytes. All are 8-bit grey and throw std::invalid_argument for a size below 16x16 px.
namespace kestrel {

/// A poster rich in texture at many scales, of which no two parts look alike.
cv::Mat poster(int width_px, int height_px, std::uint64_t seed);

/// A brick wall with rows of equal windows: the repetitive background a tracker must not take for
/// its target.
cv::Mat facade(int width_px, int height_px, double px_per_m, std::uint64_t seed);

/// Gravel and grass.
cv::Mat ground(int width_px, int height_px, std::uint64_t seed);

}  // namespace kestrel

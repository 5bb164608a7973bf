#pragma once

#include <opencv2/core/mat.hpp>

#include "../random.hpp"

namespace kestrel::sim_detail {

/// Value noise: random lattices from `coarsest_px` down to 2 px cells, each finer one weaker by
/// `fade`; float, mean 0, amplitude about 1.
cv::Mat clouds(cv::Size size, double coarsest_px, double fade, RandomStream& random);

/// picture + gain * noise, clipped to 0..255.
cv::Mat grained(const cv::Mat& picture, const cv::Mat& noise, double gain);

}  // namespace kestrel::sim_detail

#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "kestrel/vision/sift.hpp"

#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel::test {

/// A picture of 320x240 px with structures of many sizes and contrasts.
inline cv::Mat sift_picture() {
  Random random("sift_picture");
  cv::Mat gray = texture(320, 240, random);
  add_noise(gray, 2, random);
  return gray;
}

inline PixelBox whole(const cv::Mat& image) {
  return {0, 0, double(image.cols), double(image.rows)};
}

/// A row of cv::SIFT's descriptors as Descriptor defines it.
inline Descriptor root_sift(const cv::Mat& row) {
  const double sum = cv::sum(row)[0];
  Descriptor result;
  for (int b = 0; b < 128; ++b)
    result.bin[std::size_t(b)] = std::uint8_t(
        std::min(127., std::round(256 * std::sqrt(double(row.at<float>(0, b)) / sum))));
  return result;
}

inline int squared_distance(const Descriptor& a, const Descriptor& b) {
  int sum = 0;
  for (std::size_t k = 0; k < 128; ++k) {
    const int difference = int(a.bin[k]) - int(b.bin[k]);
    sum += difference * difference;
  }
  return sum;
}

/// Index of the nearest descriptor; the first of equally near ones.
inline std::size_t nearest(const Descriptor& wanted, const std::vector<Descriptor>& all) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < all.size(); ++i)
    if (squared_distance(wanted, all[i]) < squared_distance(wanted, all[best])) best = i;
  return best;
}

/// cv::SIFT's keypoints as ours: without its bias of a quarter of a pixel.
inline SiftPoints opencv_sift(const cv::Mat& gray) {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  cv::SIFT::create()->detectAndCompute(gray, cv::noArray(), keypoints, descriptors);
  SiftPoints result;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const cv::KeyPoint& k = keypoints[i];
    result.at.push_back({k.pt.x - 0.25F, k.pt.y - 0.25F, k.size / 2,
                         float(double(k.angle) * M_PI / 180), k.response});
    result.descriptors.push_back(root_sift(descriptors.row(int(i))));
  }
  return result;
}

inline double distance(const SiftPoint& a, const SiftPoint& b) {
  return std::hypot(double(a.u - b.u), double(a.v - b.v));
}

}  // namespace kestrel::test

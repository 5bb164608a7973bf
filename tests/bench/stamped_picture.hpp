#pragma once

#include <cmath>
#include <cstdint>

#include <opencv2/core.hpp>

namespace kestrel {

inline constexpr int kBits = 16;  // of milliseconds: a minute
inline constexpr int kBar_px = 20;
inline constexpr int kPeriod_ms = 40;
inline constexpr int kPictures = 200;
inline const cv::Size kSize(320, 240);

/// A poster with the time of the monotonic clock above it.
inline cv::Mat stamped(const cv::Mat& poster_picture, double now_s) {
  cv::Mat picture(kSize, CV_8UC1, cv::Scalar(128));
  poster_picture.copyTo(picture(cv::Rect(100, 80, poster_picture.cols, poster_picture.rows)));
  const auto ms = unsigned(std::int64_t(now_s * 1e3) % (1 << kBits));
  for (int bit = 0; bit < kBits; ++bit) {
    const cv::Rect bar(bit * kBar_px, 0, kBar_px, kBar_px);
    picture(bar).setTo((ms >> bit & 1U) != 0 ? 235 : 20);
  }
  return picture;
}

/// How long ago the time in a picture was, ms.
inline double age_ms(const cv::Mat& gray, double now_s) {
  unsigned ms = 0;
  for (int bit = 0; bit < kBits; ++bit) {
    const bool is_set = gray.at<uchar>(kBar_px / 2, bit * kBar_px + kBar_px / 2) > 128;
    ms |= is_set ? 1U << bit : 0U;
  }
  const double now = std::fmod(now_s * 1e3, 1 << kBits);
  return std::fmod(now - double(ms) + (1 << kBits), 1 << kBits);
}

}  // namespace kestrel

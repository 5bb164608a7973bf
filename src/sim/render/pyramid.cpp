#include "pyramid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace kestrel::sim_detail {
namespace {

/// 8 bits of fraction while the levels are made: rounded at each, they would grow brighter.
constexpr double kFraction = 256;

cv::Size size_at(int index, cv::Size texture) {
  const double scale = std::exp2(-double(index) / kLevelsPerOctave);
  return {int(std::lround(texture.width * scale)), int(std::lround(texture.height * scale))};
}

int scale_count(cv::Size texture) {
  int count = 1;
  for (cv::Size size = size_at(1, texture); std::min(size.width, size.height) >= 2;
       size = size_at(count, texture)) {
    ++count;
  }
  return count;
}

Level sharp_level(const cv::Mat& texture) {
  Level level;
  cv::Mat padded;
  cv::copyMakeBorder(texture, padded, 1, 2, 1, 2, cv::BORDER_REPLICATE);
  std::array<cv::Mat, 4> rows;
  for (int i = 0; i < 4; ++i) rows[std::size_t(i)] = padded.rowRange(i, i + texture.rows);
  cv::merge(rows.data(), rows.size(), level.grey);
  level.first = 0.5;
  level.last_s = float(texture.cols - 1);
  level.last_t = float(texture.rows - 1);
  return level;
}

/// Of the texture (of that size) resized to `picture`. A tap reads four bytes of a row, of which it
/// uses two.
Level mean_level(const cv::Mat& picture, cv::Size texture) {
  Level level;
  cv::Mat padded;
  cv::copyMakeBorder(picture, padded, 1, 2, 1, 4, cv::BORDER_REPLICATE);
  cv::blur(padded, padded, {2, 2}, {0, 0}, cv::BORDER_REPLICATE);
  padded.convertTo(level.grey, CV_8U, 1 / kFraction);
  level.per_texel_s = float(picture.cols) / float(texture.width);
  level.per_texel_t = float(picture.rows) / float(texture.height);
  level.last_s = float(picture.cols);
  level.last_t = float(picture.rows);
  return level;
}

}  // namespace

Pyramid::Pyramid(const cv::Mat& texture)
    : texture_(texture),
      sharp_(sharp_level(texture)),
      scales_(std::make_unique<std::vector<Scale>>(std::size_t(scale_count(texture.size())))) {}

/// The first octave is averaged from the texture, each further scale from the one an octave finer.
const cv::Mat& Pyramid::picture(int index) const {
  Scale& scale = (*scales_)[std::size_t(index)];
  std::call_once(scale.pictured, [&] {
    if (index == 0) {
      texture_.convertTo(scale.picture, CV_16U, kFraction);
      return;
    }
    cv::resize(picture(std::max(0, index - kLevelsPerOctave)), scale.picture,
               size_at(index, texture_.size()), 0, 0, cv::INTER_AREA);
  });
  return scale.picture;
}

const Level& Pyramid::mean(int index) const {
  index = std::clamp(index, 0, int(scales_->size()) - 1);
  Scale& scale = (*scales_)[std::size_t(index)];
  std::call_once(scale.averaged, [&] { scale.mean = mean_level(picture(index), texture_.size()); });
  return scale.mean;
}

}  // namespace kestrel::sim_detail

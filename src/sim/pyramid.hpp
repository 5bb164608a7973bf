#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace kestrel::sim_detail {

/// The texture at one scale, ready for bilinear taps.
struct Level {
  cv::Mat grey;           // its edge repeated, so that a tap needs no test
  float per_texel_s = 1;  // texels of this level per texel of the texture
  float per_texel_t = 1;
  float first = 0;   // where the first value lies: 0.5 in a texel's centre, 0 on the outer edge
  float last_s = 0;  // from the first value to the last one
  float last_t = 0;
};

/// A texture and its means.
struct Pyramid {
  float width = 0;  // of the texture, texels
  float height = 0;
  Level sharp;  // the texture itself
  /// Means over 2x2 of its texels, each level 2^(1/4) coarser, from texels half as large as the
  /// texture's on. One tap of the level whose two texels span a pixel best is then the mean over
  /// the pixel, within 9 % of its width, and edges stay where they are, also when they run along a
  /// row of pixels. (Taps of unaveraged texels would shift such edges by up to 0.1 px.)
  std::vector<Level> means;
};

constexpr int kLevelsPerOctave = 4;

inline Level sharp_level(const cv::Mat& texture) {
  Level level;
  cv::copyMakeBorder(texture, level.grey, 0, 1, 0, 1, cv::BORDER_REPLICATE);
  level.first = 0.5;
  level.last_s = float(texture.cols - 1);
  level.last_t = float(texture.rows - 1);
  return level;
}

/// 8 bits of fraction while the levels are made: rounded at each, they would grow brighter.
constexpr double kFraction = 256;

/// Of the texture (of that size) resized to `picture`, 16 bits.
inline Level mean_level(const cv::Mat& picture, cv::Size texture) {
  Level level;
  cv::Mat padded;
  cv::copyMakeBorder(picture, padded, 1, 2, 1, 2, cv::BORDER_REPLICATE);
  cv::blur(padded, padded, {2, 2}, {0, 0}, cv::BORDER_REPLICATE);
  padded.convertTo(level.grey, CV_8U, 1 / kFraction);
  level.per_texel_s = float(picture.cols) / float(texture.width);
  level.per_texel_t = float(picture.rows) / float(texture.height);
  level.last_s = float(picture.cols);
  level.last_t = float(picture.rows);
  return level;
}

/// Levels finer than the texture are interpolated, the next octave is averaged from the texture,
/// each further level from the one an octave finer.
inline std::vector<Level> mean_levels(const cv::Mat& texture) {
  std::vector<cv::Mat> pictures(1);
  texture.convertTo(pictures.front(), CV_16U, kFraction);
  std::vector<Level> levels;
  for (int i = -kLevelsPerOctave;; ++i) {
    const double scale = std::exp2(-double(i) / kLevelsPerOctave);
    const cv::Size size(int(std::lround(texture.cols * scale)),
                        int(std::lround(texture.rows * scale)));
    if (i > 0 && std::min(size.width, size.height) < 2) return levels;
    cv::Mat picture = pictures.front();
    if (i < 0) cv::resize(pictures.front(), picture, size, 0, 0, cv::INTER_LINEAR);
    if (i > 0) {
      const cv::Mat& source = pictures[std::size_t(std::max(0, i - kLevelsPerOctave))];
      cv::resize(source, picture, size, 0, 0, cv::INTER_AREA);
      pictures.push_back(picture);
    }
    levels.push_back(mean_level(picture, texture.size()));
  }
}

inline Pyramid pyramid(const cv::Mat& texture) {
  return {float(texture.cols), float(texture.rows), sharp_level(texture), mean_levels(texture)};
}

}  // namespace kestrel::sim_detail

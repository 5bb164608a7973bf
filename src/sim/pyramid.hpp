#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace kestrel::sim_detail {

/// Pixels that are worked on together: side by side in a row, so that the compiler can.
constexpr int kRun = 16;
using Run = std::array<float, kRun>;

/// The texture at one scale, its right and lower edge repeated once so that a bilinear tap needs
/// no test.
struct Level {
  cv::Mat padded;
  float per_texel_s = 1;  // texels of this level per texel of the finest
  float per_texel_t = 1;
  int width() const { return padded.cols - 1; }
  int height() const { return padded.rows - 1; }
};

/// Levels per octave. With four, the level whose texels suit a pixel best is never more than 19 %
/// off, and one bilinear tap then has nearly the response of a square pixel (0.5 to 0.6 of full
/// contrast at half a cycle per pixel, where the square has 0.64, and 4 % at one cycle).
constexpr int kLevelsPerOctave = 4;

/// The texture and its area means, each level 2^(1/4) coarser, down to a few texels across.
inline std::vector<Level> pyramid(const cv::Mat& texture) {
  std::vector<cv::Mat> pictures;
  std::vector<Level> levels;
  for (int i = 0;; ++i) {
    const double shrink = std::exp2(-double(i) / kLevelsPerOctave);
    const cv::Size size(int(std::lround(texture.cols * shrink)),
                        int(std::lround(texture.rows * shrink)));
    if (i > 0 && std::min(size.width, size.height) < 2) return levels;
    // From the level one octave finer; within the first octave from the texture itself.
    cv::Mat picture = texture;
    const int source = std::max(0, i - kLevelsPerOctave);
    if (i > 0) cv::resize(pictures[std::size_t(source)], picture, size, 0, 0, cv::INTER_AREA);
    pictures.push_back(picture);
    Level level;
    cv::copyMakeBorder(picture, level.padded, 0, 1, 0, 1, cv::BORDER_REPLICATE);
    level.per_texel_s = float(picture.cols) / float(texture.cols);
    level.per_texel_t = float(picture.rows) / float(texture.rows);
    levels.push_back(level);
  }
}

/// A pixel on the texture: a parallelogram with sides (sa, ta), one pixel to the right, and
/// (sb, tb), one pixel down; texels.
struct Footprint {
  float sa;
  float ta;
  float sb;
  float tb;
};

/// Texels from tap to tap that a level is chosen for, at least and at most.
constexpr float kMinSpacing = 1.3f;
constexpr float kMaxSpacing = 1.6f;
/// Most taps along a side; a footprint that needs more is read from a coarser level.
constexpr float kMaxTaps = 32;

/// Index of the level to read a footprint from: its narrow side spans one tap there.
inline int level_for(const Footprint& f, int levels) {
  const float longest = std::max(std::hypot(f.sa, f.ta), std::hypot(f.sb, f.tb));
  const float narrowest = std::abs(f.sa * f.tb - f.sb * f.ta) / std::max(longest, 1e-20f);
  const float texels = std::max(narrowest / kMinSpacing, longest / (kMaxTaps * kMaxSpacing));
  if (!(texels > 1)) return 0;
  return int(std::min(float(levels - 1), std::floor(kLevelsPerOctave * std::log2(texels))));
}

/// Bilinear grey levels at (s[k] + ds, t[k] + dt), texels of this level from its outer edge; beyond
/// the edge the edge's. Coordinates that are not numbers read the first texel.
inline Run taps(const Level& level, const Run& s, const Run& t, float ds, float dt) {
  const float right = float(level.width() - 1);
  const float bottom = float(level.height() - 1);
  std::array<std::int32_t, kRun> column;
  std::array<std::int32_t, kRun> row;
  Run a;
  Run b;
  for (std::size_t k = 0; k < kRun; ++k) {
    float x = s[k] + (ds - 0.5f);
    float y = t[k] + (dt - 0.5f);
    x = x > 0 ? x : 0;
    y = y > 0 ? y : 0;
    x = x < right ? x : right;
    y = y < bottom ? y : bottom;
    column[k] = std::int32_t(x);
    row[k] = std::int32_t(y);
    a[k] = x - float(column[k]);
    b[k] = y - float(row[k]);
  }
  const std::uint8_t* data = level.padded.data;
  const std::size_t step = level.padded.step[0];
  std::array<std::int32_t, kRun> upper;  // two neighbouring texels each
  std::array<std::int32_t, kRun> lower;
  for (std::size_t k = 0; k < kRun; ++k) {
    const std::uint8_t* p = data + std::size_t(row[k]) * step + column[k];
    std::uint16_t pair;
    std::memcpy(&pair, p, 2);
    upper[k] = pair;
    std::memcpy(&pair, p + step, 2);
    lower[k] = pair;
  }
  Run grey;
  for (std::size_t k = 0; k < kRun; ++k) {
    const float p = float(upper[k] & 255);
    const float q = float(lower[k] & 255);
    const float above = p + a[k] * (float(upper[k] >> 8) - p);
    const float below = q + a[k] * (float(lower[k] >> 8) - q);
    grey[k] = above + b[k] * (below - above);
  }
  return grey;
}

/// Mean grey levels over footprints centred at (s[k], t[k]), texels of the finest level from its
/// outer edge.
inline Run mean_light(const std::vector<Level>& levels, Run s, Run t, Footprint f) {
  const Level& level = levels[std::size_t(level_for(f, int(levels.size())))];
  const float x = level.per_texel_s;
  const float y = level.per_texel_t;
  f = {f.sa * x, f.ta * y, f.sb * x, f.tb * y};
  const auto count = [](float ds, float dt) {
    return std::clamp(std::ceil(std::hypot(ds, dt) / kMaxSpacing), 1.f, kMaxTaps);
  };
  const float across = count(f.sa, f.ta);
  const float down = count(f.sb, f.tb);
  for (std::size_t k = 0; k < kRun; ++k) {
    s[k] *= x;
    t[k] *= y;
  }
  Run sum{};
  for (float j = 0.5f / down - 0.5f; j < 0.5f; j += 1 / down) {
    for (float i = 0.5f / across - 0.5f; i < 0.5f; i += 1 / across) {
      const Run grey = taps(level, s, t, i * f.sa + j * f.sb, i * f.ta + j * f.tb);
      for (std::size_t k = 0; k < kRun; ++k) sum[k] += grey[k];
    }
  }
  for (float& grey : sum) grey /= across * down;
  return sum;
}

}  // namespace kestrel::sim_detail

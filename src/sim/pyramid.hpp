#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace kestrel::sim_detail {

/// Texels repeated beyond the right and lower edge, so that a bilinear tap needs no test.
constexpr int kPad = 1;

/// The texture and its means over 2x2, 4x4, ... texels down to one texel across, each padded.
inline std::vector<cv::Mat> pyramid(const cv::Mat& texture) {
  std::vector<cv::Mat> levels;
  cv::Mat level = texture;
  while (true) {
    cv::Mat padded;
    cv::copyMakeBorder(level, padded, 0, kPad, 0, kPad, cv::BORDER_REPLICATE);
    levels.push_back(padded);
    if (level.cols <= 1 || level.rows <= 1) return levels;
    cv::Mat half;
    cv::resize(level, half, {(level.cols + 1) / 2, (level.rows + 1) / 2}, 0, 0, cv::INTER_AREA);
    level = half;
  }
}

/// Grey level at (s, t), texels of this level measured from its outer edge; beyond the edge the
/// nearest edge's.
inline float tap(const cv::Mat& level, float s, float t) {
  const float x = std::clamp(s - 0.5f, 0.f, float(level.cols - kPad - 1));
  const float y = std::clamp(t - 0.5f, 0.f, float(level.rows - kPad - 1));
  const int i = int(x);
  const int j = int(y);
  const float a = x - float(i);
  const float b = y - float(j);
  const std::uint8_t* p = level.data + std::size_t(j) * level.step[0] + i;
  const std::uint8_t* q = p + level.step[0];
  const float above = float(p[0]) + a * float(p[1] - p[0]);
  const float below = float(q[0]) + a * float(q[1] - q[0]);
  return above + b * (below - above);
}

/// A parallelogram on the texture: its sides are (sa, ta) and (sb, tb), texels of the finest level.
struct Footprint {
  float sa;
  float ta;
  float sb;
  float tb;
};

/// Between half of this and this many texels of the level it is read from lie across the narrow
/// side of a footprint. More come nearer to the mean and cost more time.
constexpr float kTexelsAcross = 4;
/// Most taps along a side; a footprint that needs more is read from a coarser level.
constexpr float kMaxTaps = 32;

/// The level on which a footprint is neither coarser than its texels nor too many of them.
inline int level_for(const Footprint& f, int levels) {
  const float a2 = f.sa * f.sa + f.ta * f.ta;
  const float b2 = f.sb * f.sb + f.tb * f.tb;
  const float long2 = std::max(a2, b2);
  const float area = f.sa * f.tb - f.sb * f.ta;
  const float narrow2 = area * area / std::max(long2, 1e-30f);
  const float needed2 =
      std::max(narrow2 * (4 / (kTexelsAcross * kTexelsAcross)), long2 / (kMaxTaps * kMaxTaps));
  int level = 0;
  for (float size2 = 4; size2 <= needed2 && level + 1 < levels; size2 *= 4) ++level;
  return level;
}

/// Mean grey level over the footprint centred at (s, t), texels of the finest level from its outer
/// edge.
inline float mean_light(const std::vector<cv::Mat>& levels, float s, float t, Footprint f) {
  const int l = level_for(f, int(levels.size()));
  const cv::Mat& level = levels[std::size_t(l)];
  const cv::Mat& finest = levels.front();
  const float x = float(level.cols - kPad) / float(finest.cols - kPad);
  const float y = float(level.rows - kPad) / float(finest.rows - kPad);
  f = {f.sa * x, f.ta * y, f.sb * x, f.tb * y};
  const auto taps = [](float ds, float dt) {
    return int(std::clamp(std::ceil(std::sqrt(ds * ds + dt * dt)), 1.f, kMaxTaps));
  };
  const int across = taps(f.sa, f.ta);
  const int down = taps(f.sb, f.tb);
  f = {f.sa / float(across), f.ta / float(across), f.sb / float(down), f.tb / float(down)};
  const float first_s = s * x - (f.sa * float(across - 1) + f.sb * float(down - 1)) / 2;
  const float first_t = t * y - (f.ta * float(across - 1) + f.tb * float(down - 1)) / 2;
  float sum = 0;
  for (int j = 0; j < down; ++j) {
    for (int i = 0; i < across; ++i) {
      sum += tap(level, first_s + float(i) * f.sa + float(j) * f.sb,
                 first_t + float(i) * f.ta + float(j) * f.tb);
    }
  }
  return sum / float(across * down);
}

}  // namespace kestrel::sim_detail

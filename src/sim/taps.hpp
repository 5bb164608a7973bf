#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "pyramid.hpp"

namespace kestrel::sim_detail {

/// Pixels that are worked on together: side by side in a row, so that the compiler can.
constexpr int kRun = 16;
using Run = std::array<float, kRun>;

/// A pixel on the texture: a parallelogram with sides (sa, ta), one pixel to the right, and
/// (sb, tb), one pixel down; texels.
struct Footprint {
  float sa;
  float ta;
  float sb;
  float tb;
};

/// Longest row of taps; a footprint that needs more is read from a coarser level.
constexpr float kMaxTaps = 32;
/// Texels that one tap stands for: of the texture itself, and of a level of means with the 9 %
/// that its scale may be off.
constexpr float kSharpTap = 1;
constexpr float kMeanTap = 2.2f;

/// A level and how its taps share a footprint.
struct Reading {
  const Level* level;
  float across;  // taps
  float down;
};

/// From the level whose mean spans the narrow side of the footprint in one tap; where the texture
/// is magnified, 2x2 taps of the texture itself.
inline Reading reading(const Pyramid& pyramid, const Footprint& f) {
  const float a = std::sqrt(f.sa * f.sa + f.ta * f.ta);
  const float b = std::sqrt(f.sb * f.sb + f.tb * f.tb);
  const float longest = std::max(a, b);
  const float narrowest = std::abs(f.sa * f.tb - f.sb * f.ta) / std::max(longest, 1e-20f);
  const float texels = std::max(narrowest, longest / kMaxTaps);
  if (!(texels > 0.917f)) {  // 2^(-1/8): the finest means would be more than half a level off
    const auto taps = [](float length) { return std::max(2.f, std::ceil(length / kSharpTap)); };
    return {&pyramid.sharp, taps(a), taps(b)};
  }
  const float wanted = std::round(kLevelsPerOctave * std::log2(texels));
  const float i = std::clamp(wanted, 0.f, float(pyramid.means.size() - 1));
  const Level& level = pyramid.means[std::size_t(i)];
  const float scale = std::max(level.per_texel_s, level.per_texel_t);
  const auto taps = [scale](float length) {
    return std::clamp(std::ceil(length * scale / kMeanTap), 1.f, kMaxTaps);
  };
  return {&level, taps(a), taps(b)};
}

/// Bilinear grey levels at (s[k] + ds, t[k] + dt), texels of this level from its outer edge; beyond
/// the edge the edge's. Coordinates that are not numbers read the first texel.
inline Run taps(const Level& level, const Run& s, const Run& t, float ds, float dt) {
  const float right = level.last_s;
  const float bottom = level.last_t;
  ds -= level.first;
  dt -= level.first;
  std::array<std::int32_t, kRun> column;
  std::array<std::int32_t, kRun> row;
  Run a;
  Run b;
  for (std::size_t k = 0; k < kRun; ++k) {
    float x = s[k] + ds;
    float y = t[k] + dt;
    x = x > 0 ? x : 0;
    y = y > 0 ? y : 0;
    x = x < right ? x : right;
    y = y < bottom ? y : bottom;
    column[k] = std::int32_t(x);
    row[k] = std::int32_t(y);
    a[k] = x - float(column[k]);
    b[k] = y - float(row[k]);
  }
  const std::uint8_t* data = level.grey.data;
  const std::size_t step = level.grey.step[0];
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

/// Mean grey levels over footprints centred at (s[k], t[k]), texels of the texture from its outer
/// edge.
inline Run mean_light(const Pyramid& pyramid, Run s, Run t, Footprint f) {
  const auto [level, across, down] = reading(pyramid, f);
  const float x = level->per_texel_s;
  const float y = level->per_texel_t;
  f = {f.sa * x, f.ta * y, f.sb * x, f.tb * y};
  for (std::size_t k = 0; k < kRun; ++k) {
    s[k] *= x;
    t[k] *= y;
  }
  Run sum{};
  for (int row = 0; row < int(down); ++row) {
    const float j = (float(row) + 0.5f) / down - 0.5f;
    for (int column = 0; column < int(across); ++column) {
      const float i = (float(column) + 0.5f) / across - 0.5f;
      const Run grey = taps(*level, s, t, i * f.sa + j * f.sb, i * f.ta + j * f.tb);
      for (std::size_t k = 0; k < kRun; ++k) sum[k] += grey[k];
    }
  }
  for (float& grey : sum) grey /= across * down;
  return sum;
}

}  // namespace kestrel::sim_detail

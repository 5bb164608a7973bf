#include "reading.hpp"

#include <algorithm>
#include <cmath>

namespace kestrel::sim_detail {
namespace {

/// Longest row of taps; a footprint that needs more is read from a coarser level.
constexpr float kMaxTaps = 32;
/// Texels that one tap stands for: of the texture itself, and of a level of means with the 9 %
/// that its scale may be off.
constexpr float kSharpTap = 2;
constexpr float kMeanTap = 2.2f;
/// Narrow side from which on the first level of means, two texels a pixel, is less than half a
/// level off: 2^(1 - 1/8) texels.
constexpr float kFirstMean = 1.834f;
/// Texels^2 of a footprint's mixed moment, ss' + tt', that a rectangle leaves out: 0.02 of variance
/// beside the 0.17 that interpolation between texels has by itself.
constexpr float kAskew = 0.25f;
/// The square of a box's width over its variance.
constexpr float kBox = 12;

float taps_along(float length, float tap) {
  return length > tap ? std::min(std::ceil(length / tap), kMaxTaps) : 1;
}

/// Sides of the footprint, and shares of them that are one tap's.
struct Shares {
  Footprint tap;
  float across;
  float down;
};

Shares shares(const Footprint& f, float across, float down) {
  return {{f.sa / across, f.ta / across, f.sb / down, f.tb / down}, across, down};
}

/// Split so that no tap is longer than kSharpTap or further askew than kAskew.
Shares upright_shares(const Footprint& f, float a, float b) {
  Shares s = shares(f, taps_along(a, kSharpTap), taps_along(b, kSharpTap));
  const auto askew = [&] { return std::abs(s.tap.sa * s.tap.ta + s.tap.sb * s.tap.tb); };
  while (askew() > kAskew && s.across < kMaxTaps && s.down < kMaxTaps) {
    const bool is_wide = a / s.across > b / s.down;
    s = shares(f, s.across + (is_wide ? 1 : 0), s.down + (is_wide ? 0 : 1));
  }
  return s;
}

Reading reading_of(const SeenPlane& plane, const Level& level, const Shares& shares) {
  Reading r;
  r.texels = level.grey.data;
  r.stride = std::int32_t(level.grey.step[0]);
  r.last_s = level.last_s;
  r.last_t = level.last_t;
  const Eigen::Matrix3f& m = plane.texture_from_ray;
  for (int i = 0; i < 3; ++i) {
    r.place_from_ray[i] = level.per_texel_s * m(0, i) - level.first * m(2, i);
    r.place_from_ray[3 + i] = level.per_texel_t * m(1, i) - level.first * m(2, i);
    r.place_from_ray[6 + i] = m(2, i);
  }
  r.across = int(shares.across);
  r.down = int(shares.down);
  r.across_s = shares.tap.sa * level.per_texel_s;
  r.across_t = shares.tap.ta * level.per_texel_t;
  r.down_s = shares.tap.sb * level.per_texel_s;
  r.down_t = shares.tap.tb * level.per_texel_t;
  return r;
}

/// Lengths of a footprint's sides, and how many texels its narrow one spans.
struct Size {
  float a;
  float b;
  float texels;
};

Size size(const Footprint& f) {
  const float a = std::sqrt(f.sa * f.sa + f.ta * f.ta);
  const float b = std::sqrt(f.sb * f.sb + f.tb * f.tb);
  const float longest = std::max(a, b);
  const float narrowest = std::abs(f.sa * f.tb - f.sb * f.ta) / std::max(longest, 1e-20f);
  return {a, b, std::max(narrowest, longest / kMaxTaps)};
}

/// Sides of the rectangle with the spread of a tap and this variance more, texels.
Reading sharp_reading(const SeenPlane& plane, const Shares& s, float more_s, float more_t) {
  Reading r = reading_of(plane, plane.texture->sharp(), s);
  const auto width = [](float x, float y, float more) {
    return std::clamp(std::sqrt(x * x + y * y + kBox * more), 1e-3f, kSharpTap);
  };
  r.width_s = width(s.tap.sa, s.tap.sb, more_s);
  r.width_t = width(s.tap.ta, s.tap.tb, more_t);
  return r;
}

}  // namespace

Reading reading(const SeenPlane& plane, const Footprint& f) {
  const Size spans = size(f);
  if (!(spans.texels >= kFirstMean)) {
    return sharp_reading(plane, upright_shares(f, spans.a, spans.b), 0, 0);
  }
  const float octaves = std::min(std::log2(spans.texels) - 1, 32.f);
  const Level& level = plane.texture->mean(int(std::lround(kLevelsPerOctave * octaves)));
  const float scale = std::max(level.per_texel_s, level.per_texel_t);
  return reading_of(
      plane, level,
      shares(f, taps_along(spans.a * scale, kMeanTap), taps_along(spans.b * scale, kMeanTap)));
}

std::optional<Reading> spread_reading(const SeenPlane& plane, const Footprint& f,
                                      const Eigen::Matrix2f& covariance) {
  const Size spans = size(f);
  if (!(spans.texels < kFirstMean)) return std::nullopt;
  const Shares s = upright_shares(f, spans.a, spans.b);
  const Footprint& tap = s.tap;
  const float square_s = tap.sa * tap.sa + tap.sb * tap.sb + kBox * covariance(0, 0);
  const float square_t = tap.ta * tap.ta + tap.tb * tap.tb + kBox * covariance(1, 1);
  const float askew = tap.sa * tap.ta + tap.sb * tap.tb + kBox * covariance(0, 1);
  const bool fits =
      std::max(square_s, square_t) <= kSharpTap * kSharpTap && std::abs(askew) <= kAskew;
  if (!fits) return std::nullopt;
  return sharp_reading(plane, s, covariance(0, 0), covariance(1, 1));
}

}  // namespace kestrel::sim_detail

#pragma once

#include <algorithm>
#include <cmath>

#include "rays.hpp"
#include "seen_plane.hpp"

namespace kestrel::sim_detail {

/// Where a run's rays meet the plane, texels from the texture's outer edge, and 1 / depth, 1/m.
struct OnTexture {
  Run s;
  Run t;
  Run w;
};

inline OnTexture on_texture(const Eigen::Matrix3f& texture_from_ray, const float* rays) {
  const auto row = [&](int i) {
    const float a = texture_from_ray(i, 0);
    const float b = texture_from_ray(i, 1);
    const float c = texture_from_ray(i, 2);
    Run values;
    for (std::size_t k = 0; k < kRun; ++k) values[k] = a * rays[k] + b * rays[kRun + k] + c;
    return values;
  };
  OnTexture at{row(0), row(1), row(2)};
  Run depth;
  for (std::size_t k = 0; k < kRun; ++k) depth[k] = std::max(kNearlyAlong, at.w[k]);
  for (float& z : depth) z = 1 / z;
  for (std::size_t k = 0; k < kRun; ++k) at.s[k] *= depth[k];
  for (std::size_t k = 0; k < kRun; ++k) at.t[k] *= depth[k];
  return at;
}

inline bool is_all(const Run& run, float value) {
  return std::all_of(run.begin(), run.end(), [value](float x) { return x == value; });
}

/// A pixel of the run that meets the plane in front of the camera, by 1 / depth; -1 for none.
inline int pixel_on_plane(const Run& w) {
  for (const int k : {kRun / 2, 0, kRun - 1}) {
    if (w[std::size_t(k)] > kNearlyAlong) return k;
  }
  return -1;
}

/// Share of the pixel in which a coordinate is below its value's distance `d` from an edge: the
/// integral up to d of the density of a uniform over [-a/2, a/2] plus one over [-b/2, b/2].
inline float step_over_pixel(float d, float a, float b) {
  const float wide = std::max(a, b);
  const float narrow = std::max(std::min(a, b), 1e-6f * wide + 1e-12f);
  const float outer = (wide + narrow) / 2;
  const float inner = (wide - narrow) / 2;
  if (d <= -outer) return 0;
  if (d >= outer) return 1;
  const float scale = 1 / (2 * wide * narrow);
  if (d < -inner) return (d + outer) * (d + outer) * scale;
  if (d > inner) return 1 - (outer - d) * (outer - d) * scale;
  return 0.5f + d / wide;
}

/// Share of each pixel with 0 <= s <= length, where s changes by a to the right and by b down; w is
/// 1 / depth.
inline Run slabs(const Run& w, const Run& s, float length, float a, float b) {
  a = std::abs(a);
  b = std::abs(b);
  // Along the run s is a quotient of linear functions and grows or falls throughout (a lens bends
  // it by far less than a pixel, and each end is given half a pixel for that): the ends decide.
  const float reach = a + b;
  const auto [low, high] = std::minmax(s.front(), s.back());
  Run shares;
  shares.fill(1);
  if (std::min(w.front(), w.back()) > kNearlyAlong) {
    if (low >= reach && high <= length - reach) return shares;
    if (low >= length + reach || high <= -reach) return Run{};
  }
  for (std::size_t k = 0; k < kRun; ++k) {
    shares[k] = step_over_pixel(s[k], a, b) - step_over_pixel(s[k] - length, a, b);
  }
  return shares;
}

/// Share of each pixel that a rectangle covers, from those of its two slabs; exact but at corners.
inline Run cover(const Run& w, const Run& along_s, const Run& along_t) {
  Run shares;
  for (std::size_t k = 0; k < kRun; ++k) {
    shares[k] = w[k] > kNearlyAlong ? along_s[k] * along_t[k] : 0;
  }
  return shares;
}

}  // namespace kestrel::sim_detail

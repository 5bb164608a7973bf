#include "refine.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "../kernels/kernels.hpp"

namespace kestrel::sift {
namespace {

constexpr int kMaxMoves = 5;

/// An offset is small enough, px or layers: more than half, or an extremum in the middle between
/// two pixels would be sent from one to the other.
constexpr float kNear = 0.6F;

/// Difference of Gaussians about a pixel: value, gradient and second derivatives.
struct Quadric {
  float value = 0;
  float u = 0, v = 0, s = 0;
  float uu = 0, vv = 0, ss = 0, uv = 0, us = 0, vs = 0;
};

/// 3x3 px of one difference.
using Square = std::array<std::array<float, 3>, 3>;

Square difference(const Levels& levels, const Candidate& c, int layer) {
  Square d;
  for (int j = 0; j < 3; ++j) {
    const std::int16_t* const low = levels.planes[layer].row(c.v + j - 1) + c.u - 1;
    const std::int16_t* const high = levels.planes[layer + 1].row(c.v + j - 1) + c.u - 1;
    for (int i = 0; i < 3; ++i)
      d[std::size_t(j)][std::size_t(i)] = float(high[i] - low[i]) * (1 / kernels::kFixedScale);
  }
  return d;
}

Quadric quadric(const Levels& levels, const Candidate& c) {
  const Square below = difference(levels, c, c.layer - 1);
  const Square at = difference(levels, c, c.layer);
  const Square above = difference(levels, c, c.layer + 1);
  const float twice = 2 * at[1][1];
  Quadric q;
  q.value = at[1][1];
  q.u = 0.5F * (at[1][2] - at[1][0]);
  q.v = 0.5F * (at[2][1] - at[0][1]);
  q.s = 0.5F * (above[1][1] - below[1][1]);
  q.uu = at[1][2] + at[1][0] - twice;
  q.vv = at[2][1] + at[0][1] - twice;
  q.ss = above[1][1] + below[1][1] - twice;
  q.uv = 0.25F * (at[2][2] - at[2][0] - at[0][2] + at[0][0]);
  q.us = 0.25F * (above[1][2] - above[1][0] - below[1][2] + below[1][0]);
  q.vs = 0.25F * (above[2][1] - above[0][1] - below[2][1] + below[0][1]);
  return q;
}

struct Offset {
  float u = 0, v = 0, s = 0;
};

/// Where the quadric is extreme (Cramer's rule); empty where it is not curved enough to say.
std::optional<Offset> summit(const Quadric& q) {
  const float a = q.vv * q.ss - q.vs * q.vs;
  const float b = q.us * q.vs - q.uv * q.ss;
  const float c = q.uv * q.vs - q.us * q.vv;
  const float d = q.uu * q.ss - q.us * q.us;
  const float e = q.uv * q.us - q.uu * q.vs;
  const float f = q.uu * q.vv - q.uv * q.uv;
  const float scale = -1 / (q.uu * a + q.uv * b + q.us * c);
  const Offset x{scale * (a * q.u + b * q.v + c * q.s), scale * (b * q.u + d * q.v + e * q.s),
                 scale * (c * q.u + e * q.v + f * q.s)};
  constexpr float kFarAway = 1e4F;
  const bool near =
      std::abs(x.u) < kFarAway && std::abs(x.v) < kFarAway && std::abs(x.s) < kFarAway;
  if (!near) return std::nullopt;  // also when not a number
  return x;
}

bool is_inside(const Levels& levels, const Candidate& c) {
  return c.layer >= 1 && c.layer <= levels.layers && c.u >= kBorderPx && c.v >= kBorderPx &&
         c.u < levels.width - kBorderPx && c.v < levels.height - kBorderPx;
}

bool is_edge(const Quadric& q, double ratio) {
  const double trace = double(q.uu) + q.vv;
  const double determinant = double(q.uu) * q.vv - double(q.uv) * q.uv;
  return determinant <= 0 || trace * trace * ratio >= (ratio + 1) * (ratio + 1) * determinant;
}

int nearest(float x) { return int(std::floor(x + 0.5F)); }

}  // namespace

std::optional<Extremum> refined(const Levels& levels, const Candidate& candidate,
                                const Refinement& wanted) {
  Candidate c = candidate;
  for (int move = 0; move < kMaxMoves; ++move) {
    const Quadric q = quadric(levels, c);
    const std::optional<Offset> x = summit(q);
    if (!x) return std::nullopt;
    if (std::abs(x->u) < kNear && std::abs(x->v) < kNear && std::abs(x->s) < kNear) {
      const float contrast = std::abs(q.value + 0.5F * (q.u * x->u + q.v * x->v + q.s * x->s));
      if (contrast < wanted.contrast || is_edge(q, wanted.edge)) return std::nullopt;
      return Extremum{c, x->u, x->v, x->s, contrast};
    }
    c.u += nearest(x->u);
    c.v += nearest(x->v);
    c.layer += nearest(x->s);
    const bool is_near = std::abs(c.u - candidate.u) <= kRefineMovePx &&
                         std::abs(c.v - candidate.v) <= kRefineMovePx;
    if (!is_near || !is_inside(levels, c)) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace kestrel::sift

#include "kestrel/vision/affine_votes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/LU>

namespace kestrel {
namespace {

/// A pair whose depth is below this share of the centre's is behind the camera or nearly so.
constexpr float kLeastDepth = 0.05F;

/// Where a pair that agrees with nothing is: further from all others than any bound allows.
constexpr float kNowhere = 1e9F;

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

bool is_finite(const Pixel& p) { return std::isfinite(p.u) && std::isfinite(p.v); }

bool is_fit_to_vote(const AffinePair& pair) {
  const Eigen::Matrix2f& A = pair.image_from_template;
  return is_finite(pair.in_template) && is_finite(pair.in_image) && A.allFinite() &&
         A.determinant() > 0;
}

}  // namespace

/// Where a pair sends the others: the affine map in its image, and how far off they may be.
struct AffineVotes::Prediction {
  TurnBounds bounds;
  float xu, xv, yu, yv, u0, v0;  // u = xu * x + xv * y + u0
  float at_x, at_y;
  float squared_px, squared_share, squared_same_place;

  float left(float x, float y, float u, float v, float a, float b) const {
    const float du = u - (xu * x + xv * y + u0);
    const float dv = v - (yu * x + yv * y + v0);
    const float dx = x - at_x;
    const float dy = y - at_y;
    const float far = dx * dx + dy * dy;
    const float near = squared_px + squared_share * far - (du * du + dv * dv);
    return std::min(std::min(near, far - squared_same_place), bounds.left(a, b));
  }
};

void AffineVoteOptions::check() const {
  const auto above_0 = [](double x) { return x > 0 && std::isfinite(x); };
  require(above_0(position_px), "agreement.position_px: must be above 0");
  require(position_share >= 0 && std::isfinite(position_share),
          "agreement.position_share: must be 0 or more");
  require(log_scale > 0 && log_scale <= 3, "agreement.log_scale: must be above 0, at most 3");
  require(above_0(same_place_px), "agreement.same_place_px: must be above 0");
}

AffineVotes::Limits::Limits(const AffineVoteOptions& options)
    : cosh(float(std::cosh(options.log_scale))),
      squared_sinh(float(std::pow(std::sinh(options.log_scale), 2))),
      squared_share(float(options.position_share * options.position_share)),
      squared_px(float(options.position_px * options.position_px)),
      squared_same_place(float(options.same_place_px * options.same_place_px)) {}

AffineVotes::AffineVotes(const std::vector<AffinePair>& pairs, const AffineVoteOptions& options)
    : limits_(options), columns_(Eigen::Index(pairs.size()), int(kColumns)) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const AffinePair& pair = pairs[i];
    const Eigen::Matrix2f& A = pair.image_from_template;
    auto row = columns_.row(Eigen::Index(i));
    if (is_fit_to_vote(pair)) {
      row << float(pair.in_template.u), float(pair.in_template.v), float(pair.in_image.u),
          float(pair.in_image.v), (A(0, 0) + A(1, 1)) / 2, (A(1, 0) - A(0, 1)) / 2, A(0, 0),
          A(0, 1), A(1, 0), A(1, 1), 1;
    } else {
      row << 0, 0, kNowhere, kNowhere, kNowhere, kNowhere, 0, 0, 0, 0, 0;
    }
  }
}

TurnBounds AffineVotes::bounds(float a, float b) const {
  return {limits_.cosh * a, limits_.cosh * b, limits_.squared_sinh * (a * a + b * b)};
}

AffineVotes::Prediction AffineVotes::prediction(std::size_t voter) const {
  const auto at = columns_.row(Eigen::Index(voter));
  Prediction p{};
  p.bounds = bounds(at[TurnA], at[TurnB]);
  p.xu = at[MapXu], p.xv = at[MapXv], p.yu = at[MapYu], p.yv = at[MapYv];
  p.at_x = at[TemplateU], p.at_y = at[TemplateV];
  p.u0 = at[ImageU] - (p.xu * p.at_x + p.xv * p.at_y);
  p.v0 = at[ImageV] - (p.yu * p.at_x + p.yv * p.at_y);
  p.squared_px = limits_.squared_px;
  p.squared_share = limits_.squared_share * (at[TurnA] * at[TurnA] + at[TurnB] * at[TurnB]);
  p.squared_same_place = limits_.squared_same_place;
  return p;
}

/// Indices of the pairs for which `left` is not negative. First the numbers, then the choice: the
/// one is a loop on vectors, the other has no branch to predict.
template <class Left>
std::vector<int> AffineVotes::kept(Left left) const {
  const Eigen::Index n = columns_.rows();
  Eigen::ArrayXf all(n);
  const float* x = columns_.col(TemplateU).data();
  const float* y = columns_.col(TemplateV).data();
  const float* u = columns_.col(ImageU).data();
  const float* v = columns_.col(ImageV).data();
  const float* a = columns_.col(TurnA).data();
  const float* b = columns_.col(TurnB).data();
  float* out = all.data();
  for (Eigen::Index i = 0; i < n; ++i) out[i] = left(x[i], y[i], u[i], v[i], a[i], b[i]);
  std::vector<int> found(std::size_t(n) + 1);
  std::size_t size = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    found[size] = int(i);
    size += out[i] >= 0 ? 1 : 0;
  }
  found.resize(size);
  return found;
}

int AffineVotes::count(std::size_t voter) const {
  if (!is_usable(voter)) return 0;
  const Prediction p = prediction(voter);
  const float* x = columns_.col(TemplateU).data();
  const float* y = columns_.col(TemplateV).data();
  const float* u = columns_.col(ImageU).data();
  const float* v = columns_.col(ImageV).data();
  const float* a = columns_.col(TurnA).data();
  const float* b = columns_.col(TurnB).data();
  const Eigen::Index n = columns_.rows();
  int agreeing = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    agreeing += p.left(x[i], y[i], u[i], v[i], a[i], b[i]) >= 0 ? 1 : 0;
  }
  return agreeing;
}

std::vector<int> AffineVotes::supporters(std::size_t voter) const {
  if (!is_usable(voter)) return {};
  const Prediction p = prediction(voter);
  return kept([&p](float x, float y, float u, float v, float a, float b) {
    return p.left(x, y, u, v, a, b);
  });
}

double AffineVotes::squared_tolerance_px2(std::size_t voter, std::size_t pair) const {
  const auto from = columns_.row(Eigen::Index(voter));
  const auto to = columns_.row(Eigen::Index(pair));
  const float dx = to[TemplateU] - from[TemplateU];
  const float dy = to[TemplateV] - from[TemplateV];
  const float share =
      limits_.squared_share * (from[TurnA] * from[TurnA] + from[TurnB] * from[TurnB]);
  return double(limits_.squared_px + share * (dx * dx + dy * dy));
}

std::vector<int> AffineVotes::near(const Eigen::Matrix3d& H, const TurnBounds& bounds,
                                   double reach_px) const {
  const Eigen::Matrix3f h = H.cast<float>();
  const auto squared_reach = float(reach_px * reach_px);
  return kept([&](float x, float y, float u, float v, float a, float b) {
    const float depth = h(2, 0) * x + h(2, 1) * y + h(2, 2);
    const float du = (h(0, 0) * x + h(0, 1) * y + h(0, 2)) / depth - u;
    const float dv = (h(1, 0) * x + h(1, 1) * y + h(1, 2)) / depth - v;
    return std::min(std::min(depth - kLeastDepth, bounds.left(a, b)),
                    squared_reach - (du * du + dv * dv));
  });
}

TurnBounds AffineVotes::bounds(const Eigen::Matrix2d& image_from_template) const {
  const Eigen::Matrix2f A = image_from_template.cast<float>();
  return bounds((A(0, 0) + A(1, 1)) / 2, (A(1, 0) - A(0, 1)) / 2);
}

}  // namespace kestrel

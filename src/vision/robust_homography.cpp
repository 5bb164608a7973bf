#include "kestrel/vision/robust_homography.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <Eigen/Core>

namespace kestrel {
namespace {

/// Refits after which a set of inliers that still changes is taken as it is.
constexpr int kMaxRefits = 10;

/// A triangle flatter than this has no orientation that keypoint noise could not turn.
constexpr double kMinHeightPx = 1;

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

/// splitmix64 (Steele, Lea & Flood 2014): the same numbers on every machine.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}

  /// In [0, n), n > 0: the top 32 bits scaled; its bias of n / 2^32 is below notice.
  std::size_t below(std::size_t n) { return std::size_t(((next() >> 32) * n) >> 32); }

 private:
  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15ull;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

/// Four different pairs.
std::vector<PixelPair> draw_four(const std::vector<PixelPair>& pairs, Chance& chance) {
  std::array<std::size_t, 4> drawn{};
  std::vector<PixelPair> four;
  four.reserve(4);
  while (four.size() < 4) {
    const std::size_t i = chance.below(pairs.size());
    const auto end = drawn.begin() + std::ptrdiff_t(four.size());
    if (std::find(drawn.begin(), end, i) != end) continue;
    drawn[four.size()] = i;
    four.push_back(pairs[i]);
  }
  return four;
}

/// Height of triangle abc over its longest side, px, with the sign of its orientation.
double signed_height(const Pixel& a, const Pixel& b, const Pixel& c) {
  const double cross = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
  return cross / std::max({distance(a, b), distance(b, c), distance(c, a)});
}

/// False when no homography with the template in front of the camera can be drawn through the four
/// pairs: three of them on a line, or a triangle that changes its orientation.
bool is_sound(const std::vector<PixelPair>& four) {
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    const PixelPair& a = four[(left_out + 1) % 4];
    const PixelPair& b = four[(left_out + 2) % 4];
    const PixelPair& c = four[(left_out + 3) % 4];
    const double h = signed_height(a.in_template, b.in_template, c.in_template);
    const double hp = signed_height(a.in_image, b.in_image, c.in_image);
    if (!(std::abs(h) >= kMinHeightPx && std::abs(hp) >= kMinHeightPx && h * hp > 0)) return false;
  }
  return true;
}

/// A homography with the pairs that agree with it.
struct Model {
  Homography homography;
  std::vector<int> inliers;
  double squared_error = 0;  // of the inliers, px^2

  bool beats(const Model& other) const {
    return inliers.size() != other.inliers.size() ? inliers.size() > other.inliers.size()
                                                  : squared_error < other.squared_error;
  }
};

/// The paper's count: pairs whose reprojection error is below the tolerance, on the same side of
/// the camera as the point the model was fitted at.
Model supported(const Homography& homography, const Pixel& fitted_at,
                const std::vector<PixelPair>& pairs, double tolerance_px) {
  Model model{homography, {}, 0};
  const Eigen::Matrix3d& H = homography.H;
  const auto depth = [&H](const Pixel& p) { return H(2, 0) * p.u + H(2, 1) * p.v + H(2, 2); };
  const double side = depth(fitted_at) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Pixel& p = pairs[i].in_template;
    const double w = depth(p);
    if (!(w * side > 0)) continue;
    const double du = (H(0, 0) * p.u + H(0, 1) * p.v + H(0, 2)) / w - pairs[i].in_image.u;
    const double dv = (H(1, 0) * p.u + H(1, 1) * p.v + H(1, 2)) / w - pairs[i].in_image.v;
    const double d2 = du * du + dv * dv;
    if (!(d2 < tolerance_px * tolerance_px)) continue;
    model.inliers.push_back(int(i));
    model.squared_error += d2;
  }
  return model;
}

/// The model fitted to all inliers of another one; empty when they are degenerate.
std::optional<Model> refitted(const Model& model, const std::vector<PixelPair>& pairs,
                              double tolerance_px) {
  std::vector<PixelPair> chosen;
  chosen.reserve(model.inliers.size());
  for (const int i : model.inliers) chosen.push_back(pairs[std::size_t(i)]);
  const auto H = fit_homography(chosen);
  if (!H) return std::nullopt;
  return supported(*H, chosen.front().in_template, pairs, tolerance_px);
}

/// Refits until the inliers stay the same, at most kMaxRefits times.
std::optional<Model> settled(Model model, const std::vector<PixelPair>& pairs,
                             double tolerance_px) {
  for (int i = 0; i < kMaxRefits; ++i) {
    auto next = refitted(model, pairs, tolerance_px);
    if (!next) return std::nullopt;
    const bool stays = next->inliers == model.inliers;
    model = *std::move(next);
    if (stays) break;
  }
  return model;
}

/// Trials after which four inliers have been drawn at once with the wanted confidence
/// (Fischler & Bolles 1981).
double trials_needed(std::size_t inliers, std::size_t pairs, double confidence) {
  const double share = double(inliers) / double(pairs);
  const double miss = 1 - share * share * share * share;  // one trial draws an outlier
  if (miss <= 0) return 0;
  return miss < 1 ? std::log(1 - confidence) / std::log(miss)
                  : std::numeric_limits<double>::infinity();
}

/// The best model of one trial: of the four pairs, or refitted when that agrees with more.
std::optional<Model> trial(const std::vector<PixelPair>& four, const std::vector<PixelPair>& pairs,
                           const Model& best, double tolerance_px) {
  if (!is_sound(four)) return std::nullopt;
  const auto H = fit_homography(four);
  if (!H) return std::nullopt;
  Model model = supported(*H, four.front().in_template, pairs, tolerance_px);
  if (model.inliers.size() < 4 || !model.beats(best)) return std::nullopt;
  if (auto better = refitted(model, pairs, tolerance_px); better && better->beats(model)) {
    model = *std::move(better);
  }
  return model;
}

}  // namespace

void RansacOptions::check() const {
  require(max_reprojection_px > 0 && std::isfinite(max_reprojection_px),
          "ransac.max_reprojection_px: must be above 0");
  require(min_inliers >= 4, "ransac.min_inliers: must be at least 4");
  require(min_inlier_share >= 0 && min_inlier_share <= 1,
          "ransac.min_inlier_share: must be 0 to 1");
  require(max_trials >= 1, "ransac.max_trials: must be at least 1");
  require(confidence > 0 && confidence < 1, "ransac.confidence: must be between 0 and 1");
}

int consensus(std::size_t matches, const RansacOptions& options) {
  return std::max(options.min_inliers, int(std::ceil(options.min_inlier_share * double(matches))));
}

std::optional<RobustHomography> ransac_homography(const std::vector<PixelPair>& pairs,
                                                  const RansacOptions& options) {
  const auto wanted = std::size_t(consensus(pairs.size(), options));
  if (pairs.size() < std::max<std::size_t>(wanted, 4)) return std::nullopt;
  Chance chance(options.seed);
  Model best;
  int trials = 0;
  double needed = options.max_trials;
  while (trials < options.max_trials && trials < needed) {
    ++trials;
    auto model = trial(draw_four(pairs, chance), pairs, best, options.max_reprojection_px);
    if (!model) continue;
    best = *std::move(model);
    if (best.inliers.size() >= wanted) {
      needed = trials_needed(best.inliers.size(), pairs.size(), options.confidence);
    }
  }
  if (best.inliers.size() < wanted) return std::nullopt;
  auto final = settled(std::move(best), pairs, options.max_reprojection_px);
  if (!final || final->inliers.size() < wanted) return std::nullopt;
  return RobustHomography{final->homography, std::move(final->inliers), trials};
}

}  // namespace kestrel

#include "kestrel/vision/align.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "align/block_kernels.hpp"
#include "align/normal_equations.hpp"
#include "align/warp_reach.hpp"

namespace kestrel {
namespace {

constexpr int kPixels = kernel::kBlockPixels;

/// Neighbouring pixels' residuals are alike (blur, aliasing): about this many count as one.
constexpr double kCorrelatedPixels = 4;

/// What remains of bilinear sampling and of the picture's own noise however many pixels agree, px.
constexpr double kLeastDeviationPx = 0.01;

/// A step larger than this, in coordinates of warp(), leaves the range of its linearisation.
constexpr double kLargestStep = 0.3;

/// Damping after the first step that fails, which halves a step, and its factor after the next
/// ones.
constexpr double kDamped = 1;
constexpr double kMoreDamping = 3;

/// Fewer blocks than this cannot hold all eight parameters.
constexpr int kBlocksForHomography = 6;

/// A level of the template and the level of the image that shows it at about the same size.
struct LevelPair {
  int in_template = 0;
  int in_image = 0;
};

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

/// The template's size in the image over its size, from the areas.
double scale(const Homography& H, const TemplateBlocks& blocks) {
  const double area = signed_area(outline(H, blocks.width, blocks.height));
  return area > 0 ? std::sqrt(area / ((blocks.width - 1) * (blocks.height - 1))) : 1;
}

/// The finest pair of levels whose sizes differ by less than a factor of sqrt(2).
LevelPair finest_pair(const Homography& H, const TemplateBlocks& blocks,
                      const ImagePyramid& image) {
  const int octaves = int(std::lround(std::log2(scale(H, blocks))));
  return {std::clamp(-octaves, 0, int(blocks.levels.size()) - 1),
          std::clamp(octaves, 0, image.levels() - 1)};
}

/// How many pairs there are, the finest and those coarser by the same octaves.
int pair_count(const LevelPair& finest, const TemplateBlocks& blocks, const ImagePyramid& image) {
  int count = 1;
  while (finest.in_template + count < int(blocks.levels.size()) &&
         finest.in_image + count < image.levels() &&
         !blocks.levels[std::size_t(finest.in_template) + std::size_t(count)].blocks.empty()) {
    ++count;
  }
  return count;
}

kernel::Image sampled(const PyramidLevel& level) {
  // Four bytes are read at a pixel and at the one below: the last row is left out, so that they
  // are always there.
  // The margin is above the rounding of a coordinate in the thousands.
  constexpr float kInside = 0.01f;
  return {level.pixels,
          level.stride,
          float(level.left) + kInside,
          float(level.top) + kInside,
          float(level.right - 1) - kInside,
          float(level.bottom - 2) - kInside};
}

}  // namespace

struct Aligner::Scratch {
  Eigen::Matrix3d scaled;
  Eigen::Matrix3d from_scaled;
  std::vector<std::vector<kernel::Block>> blocks;  // by level
  std::vector<kernel::BlockSums> sums;
  std::vector<BlockLikeness> likeness;
  kernel::SampleBlocks sample = nullptr;
  kernel::SampleBlocks score = nullptr;

  /// Looks at a level of the image with a level of the template.
  void look(kernel::SampleBlocks kernel_of, const ImagePyramid& image, const LevelPair& at,
            const Homography& H, int count) {
    const Eigen::Matrix3d G =
        level0_from_level(at.in_image).inverse() * H.H * level0_from_level(at.in_template);
    const Eigen::Matrix<float, 3, 3, Eigen::RowMajor> h = (G / G(2, 2)).cast<float>();
    kernel_of(sampled(image.level(at.in_image)), h.data(),
              blocks[std::size_t(at.in_template)].data(), count, sums.data());
  }

  Normal measured(const TemplateBlocks& all, const AlignOptions& options, const ImagePyramid& image,
                  const LevelPair& at, const Homography& H) {
    const BlockLevel& level = all.levels[std::size_t(at.in_template)];
    look(sample, image, at, H, int(level.blocks.size()));
    return normal_equations(level, sums, options, all.options);
  }

  /// The motion of the template that would explain what the image shows, shortened by the damping;
  /// empty when that does not determine one.
  std::optional<Vector8d> step(Normal n, double damping, const TemplateBlocks& all) const {
    n.information.diagonal() *= 1 + damping;
    auto parameters = solved(n, n.blocks >= kBlocksForHomography ? 8 : n.blocks >= 2 ? 4 : 2);
    if (!parameters) return std::nullopt;
    const double far = std::max(reach(warp(*parameters), scaled, all), parameters->norm());
    if (far > kLargestStep) *parameters *= kLargestStep / far;
    return parameters;
  }

  /// How far a step moves the texture that takes part, root mean square, in coordinates of warp():
  /// corners that nothing is seen of do not count.
  static double moved(const Vector8d& parameters, const Normal& n) {
    const double of_a_shift = (n.information(0, 0) + n.information(1, 1)) / 2;
    return std::sqrt(parameters.dot(n.information * parameters) / of_a_shift);
  }

  /// A place, and what the image shows there.
  struct Look {
    Homography at;
    Normal seen;
  };

  /// The start where it shows more than the place a coarser level led to: what is fine texture to
  /// one level is noise to the next.
  Look begun(const TemplateBlocks& all, const AlignOptions& options, const ImagePyramid& image,
             const LevelPair& at, const Homography& start, const Homography& led, int& taken) {
    Look there{led, measured(all, options, image, at, led)};
    ++taken;
    if (led.H == start.H) return there;
    Look before{start, measured(all, options, image, at, start)};
    return before.seen.shown > there.seen.shown ? before : there;
  }

  /// When a descent ends and which steps are believed; lengths in coordinates of warp().
  struct Bounds {
    int steps = 0;
    double tolerance = 0;  // a step that moves no corner by more is the last
    double range = 0;      // of the linearisation: an eighth of the finest texture's period, 2 px
  };

  /// Gauss-Newton steps at one level, damped as Levenberg and Marquardt do: a step beyond the range
  /// of its linearisation to where the image shows less of the template is taken back and tried
  /// shorter. Where they do not
  /// settle, of the places passed the one that shows most.
  Homography descended(const TemplateBlocks& all, const AlignOptions& options,
                       const ImagePyramid& image, const LevelPair& at, Look now,
                       const Bounds& bounds, int& taken) {
    double damping = 0;
    Homography best = now.at;
    double most = now.seen.shown;
    for (int i = 0; i < bounds.steps; ++i) {
      const auto parameters = step(now.seen, damping, all);
      if (!parameters) break;
      const Eigen::Matrix3d W = warp(*parameters);
      Look next;
      next.at.H = now.at.H * (from_scaled * W.inverse() * scaled);
      next.at.H /= next.at.H(2, 2);
      if (reach(W, scaled, all) < bounds.tolerance) return next.at;
      next.seen = measured(all, options, image, at, next.at);
      ++taken;
      const bool is_less = next.seen.shown < now.seen.shown;
      if (is_less && moved(*parameters, now.seen) > bounds.range) {
        damping = std::max(kDamped, damping * kMoreDamping);
        continue;
      }
      damping = damping > kDamped ? damping / kMoreDamping : 0;
      now = next;
      if (now.seen.shown < most) continue;
      most = now.seen.shown;
      best = now.at;
    }
    return best;
  }

  Agreement agreement_of(const BlockLevel& level, const AgreementOptions& options) {
    likeness.clear();
    for (std::size_t i = 0; i < level.blocks.size(); ++i) {
      const bool is_visible = sums[i].is_visible != 0;
      likeness.push_back({is_visible, is_visible ? zncc(level.blocks[i], sums[i]) : 0});
    }
    return agreement(likeness, options);
  }

  /// How well the image agrees with the answer, and how sure that makes it.
  void finish(const TemplateBlocks& all, const AlignOptions& options, const ImagePyramid& image,
              const LevelPair& finest, Alignment& result) {
    const BlockLevel& level = all.levels[std::size_t(finest.in_template)];
    const Normal n = measured(all, options, image, finest, result.image_from_template);
    result.agreement.fine = agreement_of(level, options.agreement);
    const double per_residual = std::max(n.freedom > 0 ? n.residual / n.freedom : 1, 1e-6);
    const Matrix8d J = corner_derivatives(result.image_from_template, scaled, all);
    const Matrix8d covariance = n.information.ldlt().solve(J.transpose());
    result.corner_covariance = kCorrelatedPixels * per_residual * J * covariance +
                               kLeastDeviationPx * kLeastDeviationPx * Matrix8d::Identity();
    if (pair_count(finest, all, image) > 1) {
      const LevelPair next{finest.in_template + 1, finest.in_image + 1};
      const BlockLevel& half = all.levels[std::size_t(next.in_template)];
      look(score, image, next, result.image_from_template, int(half.blocks.size()));
      result.agreement.coarse = agreement_of(half, options.agreement);
    }
    result.is_accepted = kestrel::is_accepted(result.agreement, options.agreement);
  }
};

void AlignOptions::check() const {
  require(max_iterations >= 1 && max_iterations <= 100, "align.max_iterations: must be 1 to 100");
  require(tolerance_px > 0 && std::isfinite(tolerance_px), "align.tolerance_px: must be above 0");
  require(weight_scale > 0 && std::isfinite(weight_scale), "align.weight_scale: must be above 0");
  require(search_radius_px >= 0 && search_radius_px <= 32,
          "align.search_radius_px: must be 0 to 32");
  agreement.check();
}

Aligner::Aligner(TemplateBlocks blocks, const AlignOptions& options)
    : blocks_(std::move(blocks)), options_(options), scratch_(std::make_unique<Scratch>()) {
  options.check();
  require(!blocks_.levels.empty(), "template: has no level");
  scratch_->scaled = scaled_from_template(blocks_.width, blocks_.height);
  scratch_->from_scaled = scratch_->scaled.inverse();
  const bool avx2 = use_avx2(options.simd);
  scratch_->sample = avx2 ? kernel::sample_blocks_avx2 : kernel::sample_blocks_baseline;
  scratch_->score = avx2 ? kernel::score_blocks_avx2 : kernel::score_blocks_baseline;
  std::size_t most = 0;
  for (const BlockLevel& level : blocks_.levels) {
    std::vector<kernel::Block>& known = scratch_->blocks.emplace_back();
    for (std::size_t i = 0; i < level.blocks.size(); ++i) {
      known.push_back({float(level.blocks[i].u), float(level.blocks[i].v),
                       level.textures.data() + i * kPixels,
                       level.derivatives.data() + i * kPixels * kernel::kParameters});
    }
    most = std::max(most, level.blocks.size());
  }
  scratch_->sums.resize(most);
  scratch_->likeness.reserve(most);
}

Aligner::~Aligner() = default;
Aligner::Aligner(Aligner&&) noexcept = default;
Aligner& Aligner::operator=(Aligner&&) noexcept = default;

int Aligner::levels() const { return int(blocks_.levels.size()); }

double Aligner::likeness_at(const ImagePyramid& image, const Homography& H, int in_template,
                            int in_image) {
  const BlockLevel& level = blocks_.levels[std::size_t(in_template)];
  scratch_->look(scratch_->score, image, {in_template, in_image}, H, int(level.blocks.size()));
  double explained = 0;
  double all = 0;
  for (std::size_t i = 0; i < level.blocks.size(); ++i) {
    const double weight = std::sqrt(level.blocks[i].texture_norm2);
    all += weight;
    if (scratch_->sums[i].is_visible == 0) continue;
    const double c = std::max(zncc(level.blocks[i], scratch_->sums[i]), 0.0);
    explained += weight * c * c;
  }
  return all > 0 ? explained / all : 0;
}

double Aligner::likeness(const ImagePyramid& image, const Homography& image_from_template) {
  const LevelPair finest = finest_pair(image_from_template, blocks_, image);
  const int coarser = pair_count(finest, blocks_, image) - 1;
  return likeness_at(image, image_from_template, finest.in_template + coarser,
                     finest.in_image + coarser);
}

double Aligner::detail(const ImagePyramid& image, const Homography& image_from_template) {
  const LevelPair finest = finest_pair(image_from_template, blocks_, image);
  return likeness_at(image, image_from_template, finest.in_template, finest.in_image);
}

Homography Aligner::search(const ImagePyramid& image, const Homography& start) {
  const LevelPair finest = finest_pair(start, blocks_, image);
  const int coarser = pair_count(finest, blocks_, image) - 1;
  const double step = double(1 << (finest.in_image + coarser));
  Homography best = start;
  double most = likeness(image, start);
  for (int j = -options_.search_radius_px; j <= options_.search_radius_px; ++j) {
    for (int i = -options_.search_radius_px; i <= options_.search_radius_px; ++i) {
      Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
      shift(0, 2) = i * step;
      shift(1, 2) = j * step;
      const Homography shifted{shift * start.H};
      const double alike = likeness(image, shifted);
      if (alike <= most) continue;
      most = alike;
      best = shifted;
    }
  }
  return best;
}

std::optional<Alignment> Aligner::align(const ImagePyramid& image, const Homography& start) {
  Alignment result;
  result.image_from_template = start;
  Homography& H = result.image_from_template;
  const LevelPair finest = finest_pair(start, blocks_, image);
  const double px = scale(start, blocks_) * std::max(blocks_.width, blocks_.height) / 2;
  for (int k = pair_count(finest, blocks_, image) - 1; k >= 0; --k) {
    const LevelPair at{finest.in_template + k, finest.in_image + k};
    const double half_pixel = 0.5 * double(1 << k) / px;
    // A coarse level need only lead into the range of the next: half a pixel of its own.
    const Scratch::Bounds bounds{
        k == 0 ? options_.max_iterations : (options_.max_iterations + 1) / 2,
        k == 0 ? options_.tolerance_px / px : half_pixel, half_pixel / 2};
    const auto begun = scratch_->begun(blocks_, options_, image, at, start, H, result.iterations);
    H = scratch_->descended(blocks_, options_, image, at, begun, bounds, result.iterations);
  }
  if (!is_plausible(H, blocks_.width, blocks_.height)) return std::nullopt;
  scratch_->finish(blocks_, options_, image, finest, result);
  if (result.agreement.fine.visible_share() < options_.agreement.min_visible_share)
    return std::nullopt;
  return result;
}

}  // namespace kestrel

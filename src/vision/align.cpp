#include "kestrel/vision/align.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <Eigen/Cholesky>

#include "kestrel/geometry/straight_view.hpp"

#include "align/block_look.hpp"
#include "align/descent.hpp"
#include "align/level_pairs.hpp"
#include "align/warp_reach.hpp"

namespace kestrel {
namespace {

/// Neighbouring pixels' residuals are alike (blur, aliasing): about this many count as one.
constexpr double kCorrelatedPixels = 4;

/// What remains of bilinear sampling and of the picture's own noise however many pixels agree, px.
constexpr double kLeastDeviationPx = 0.01;

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

/// Of the corners, from what the residuals leave open.
Matrix8d corner_covariance(const Normal& n, const Homography& H, const Eigen::Matrix3d& scaled,
                           const TemplateBlocks& blocks) {
  const double per_residual = std::max(n.freedom > 0 ? n.residual / n.freedom : 1, 1e-6);
  const Matrix8d J = corner_derivatives(H, scaled, blocks);
  const Matrix8d covariance = n.information.ldlt().solve(J.transpose());
  return kCorrelatedPixels * per_residual * J * covariance +
         kLeastDeviationPx * kLeastDeviationPx * Matrix8d::Identity();
}

}  // namespace

struct Aligner::Parts {
  BlockLook look;
  Eigen::Matrix3d scaled;  // scaled_from_template()
  std::optional<Camera> lens;

  /// Where the camera without its lens sees what is at this place; empty where it cannot.
  std::optional<Homography> straight(const Homography& image_from_template) const {
    if (!lens) return image_from_template;
    const TemplateBlocks& blocks = look.blocks();
    const auto view = straight_view(image_from_template, blocks.width, blocks.height, *lens);
    return view ? std::optional(view->image_from_template) : std::nullopt;
  }
  /// The other way.
  std::optional<Homography> bent(const Homography& straight_from_template) const {
    if (!lens) return straight_from_template;
    const TemplateBlocks& blocks = look.blocks();
    return bent_view(straight_from_template, blocks.width, blocks.height, *lens);
  }

  LevelPair finest(const ImagePyramid& image, const Homography& H) const {
    return finest_pair(H, look.blocks(), image);
  }
  LevelPair coarsest(const ImagePyramid& image, const Homography& H) const {
    const LevelPair finest = this->finest(image, H);
    return finest.coarser(pair_count(finest, look.blocks(), image) - 1);
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

Aligner::Aligner(TemplateBlocks blocks, const AlignOptions& options) : options_(options) {
  options.check();
  require(!blocks.levels.empty(), "template: has no level");
  const Eigen::Matrix3d scaled = scaled_from_template(blocks.width, blocks.height);
  parts_ =
      std::make_unique<Parts>(Parts{BlockLook(std::move(blocks), options), scaled, options.lens});
}

Aligner::~Aligner() = default;
Aligner::Aligner(Aligner&&) noexcept = default;
Aligner& Aligner::operator=(Aligner&&) noexcept = default;

int Aligner::levels() const { return int(parts_->look.blocks().levels.size()); }

double Aligner::likeness(const ImagePyramid& image, const Homography& image_from_template) {
  const auto H = parts_->straight(image_from_template);
  return H ? parts_->look.likeness(image, parts_->coarsest(image, *H), *H) : 0;
}

double Aligner::detail(const ImagePyramid& image, const Homography& image_from_template) {
  const auto H = parts_->straight(image_from_template);
  return H ? parts_->look.likeness(image, parts_->finest(image, *H), *H) : 0;
}

Homography Aligner::search(const ImagePyramid& image, const Homography& start) {
  const auto from = parts_->straight(start);
  if (!from) return start;
  const double step = double(1 << parts_->coarsest(image, *from).in_image);
  const auto likeness_at = [&](const Homography& H) {
    return parts_->look.likeness(image, parts_->coarsest(image, H), H);
  };
  Homography best = *from;
  double most = likeness_at(*from);
  for (int j = -options_.search_radius_px; j <= options_.search_radius_px; ++j) {
    for (int i = -options_.search_radius_px; i <= options_.search_radius_px; ++i) {
      Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
      shift(0, 2) = i * step;
      shift(1, 2) = j * step;
      const Homography shifted{shift * from->H};
      const double alike = likeness_at(shifted);
      if (alike <= most) continue;
      most = alike;
      best = shifted;
    }
  }
  if (best.H == from->H) return start;
  return parts_->bent(best).value_or(start);
}

std::optional<Alignment> Aligner::align(const ImagePyramid& image, const Homography& start) {
  const auto from = parts_->straight(start);
  if (!from) return std::nullopt;
  BlockLook& look = parts_->look;
  const TemplateBlocks& blocks = look.blocks();
  Alignment result;
  Homography& H = result.straight_from_template;
  H = *from;
  const LevelPair finest = parts_->finest(image, *from);
  const int pairs = pair_count(finest, blocks, image);
  const double px = scale(*from, blocks) * std::max(blocks.width, blocks.height) / 2;
  for (int k = pairs - 1; k >= 0; --k) {
    const double half_pixel = 0.5 * double(1 << k) / px;
    // A coarse level need only lead into the range of the next: half a pixel of its own.
    const DescentBounds bounds{k == 0 ? options_.max_iterations : (options_.max_iterations + 1) / 2,
                               k == 0 ? options_.tolerance_px / px : half_pixel, half_pixel / 2};
    const Descended led =
        descend(look, image, finest.coarser(k), {*from, H}, bounds, parts_->scaled);
    H = led.image_from_template;
    result.iterations += led.looks;
  }
  const auto seen = parts_->bent(H);
  if (!seen || !is_plausible(H, blocks.width, blocks.height)) return std::nullopt;
  result.image_from_template = *seen;
  result.corner_covariance =
      corner_covariance(look.measured(image, finest, H), *seen, parts_->scaled, blocks);
  result.agreement.fine = look.agreement_as_measured(finest);
  if (pairs > 1) result.agreement.coarse = look.agreement(image, finest.coarser(1), H);
  result.is_accepted = kestrel::is_accepted(result.agreement, options_.agreement);
  if (result.agreement.fine.visible_share() < options_.agreement.min_visible_share) {
    return std::nullopt;
  }
  return result;
}

}  // namespace kestrel

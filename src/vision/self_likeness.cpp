#include "kestrel/vision/self_likeness.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace kestrel {
namespace {

/// Shifts tried, in eighths of the picture's size, to each side: beyond half of it too little is
/// left to compare.
constexpr int kEighths = 4;

/// An answer this near to the picture itself, as a share of its longer side, is the picture itself.
constexpr double kSamePlaceShare = 0.06;

/// The picture turned about its centre by so many quarters, then shifted.
Homography moved(const TemplateBlocks& b, int quarters, double du, double dv) {
  const double u = (b.width - 1) / 2;
  const double v = (b.height - 1) / 2;
  const double c = std::array<double, 4>{1, 0, -1, 0}[std::size_t(quarters)];
  const double s = std::array<double, 4>{0, 1, 0, -1}[std::size_t(quarters)];
  Eigen::Matrix3d H;
  H << c, -s, u - c * u + s * v + du, s, c, v - s * u - c * v + dv, 0, 0, 1;
  return {H};
}

bool is_elsewhere(const Homography& H, const TemplateBlocks& b) {
  const auto at = outline(H, b.width, b.height);
  const auto home = template_corners(b.width, b.height);
  double farthest = 0;
  for (std::size_t i = 0; i < 4; ++i) farthest = std::max(farthest, distance(at[i], home[i]));
  return farthest > kSamePlaceShare * std::max(b.width, b.height);
}

}  // namespace

double self_likeness(const cv::Mat& picture, const TemplateBlocks& blocks,
                     const AlignOptions& options) {
  Aligner aligner(blocks, options);
  ImagePyramid pyramid;
  pyramid.look(picture, {0, 0, blocks.width, blocks.height}, aligner.levels(), options.simd);
  double most = 0;
  for (int quarters = 0; quarters < 4; ++quarters) {
    for (int j = -kEighths; j <= kEighths; ++j) {
      for (int i = -kEighths; i <= kEighths; ++i) {
        if (quarters == 0 && i == 0 && j == 0) continue;
        const auto found = aligner.align(
            pyramid, moved(blocks, quarters, i * blocks.width / 8, j * blocks.height / 8));
        if (!found || !found->is_accepted || !is_elsewhere(found->image_from_template, blocks)) {
          continue;
        }
        most =
            std::max(most, found->agreement.alike_share() * found->agreement.fine.visible_share());
      }
    }
  }
  return most;
}

AgreementOptions beyond_self_likeness(AgreementOptions options, double self_likeness) {
  if (self_likeness > 0) {
    options.min_alike_share = std::max(options.min_alike_share, (1 + self_likeness) / 2);
  }
  return options;
}

}  // namespace kestrel

#include "normal_equations.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace kestrel {
namespace {

constexpr int kPixels = kernel::kBlockPixels;

double image_norm2(const kernel::BlockSums& sums) {
  return double(sums.image_squared) - double(sums.image) * sums.image / kPixels;
}

}  // namespace

double zncc(const TemplateBlock& block, const kernel::BlockSums& sums) {
  const double norm2 = image_norm2(sums);
  // Below the rounding of eight bits there is no picture.
  if (norm2 < kPixels / 12.0) return 0;
  return sums.texture_image / std::sqrt(norm2 * block.texture_norm2);
}

Normal normal_equations(const BlockLevel& level, const std::vector<kernel::BlockSums>& sums,
                        const AlignOptions& options, const BlockOptions& noise) {
  Normal n;
  double all = 0;
  for (std::size_t i = 0; i < level.blocks.size(); ++i) {
    const TemplateBlock& block = level.blocks[i];
    all += std::sqrt(block.texture_norm2);
    if (sums[i].is_visible == 0) continue;
    const double c = zncc(block, sums[i]);
    if (c <= 0) continue;
    n.shown += std::sqrt(block.texture_norm2) * std::min(c * c, 1.0);
    const double gain = double(sums[i].texture_image) / block.texture_norm2;
    const double model = noise.model_error * gain;
    const double variance =
        noise.noise_grey * noise.noise_grey + model * model * block.texture_norm2 / kPixels;
    const double root = options.weight_scale / (options.weight_scale + 1 - std::min(c * c, 1.0));
    const double weight = root * root / variance;
    n.information += weight * gain * gain * block.information;
    const Eigen::Map<const Eigen::Matrix<float, 8, 1>> g(sums[i].derivatives);
    n.gradient += weight * gain * g.cast<double>();
    n.residual += weight * image_norm2(sums[i]) * (1 - std::min(c * c, 1.0));
    n.freedom += root * root * (kPixels - 2);
    ++n.blocks;
  }
  if (all > 0) n.shown /= all;
  return n;
}

std::optional<Vector8d> solved(const Normal& n, int parameters) {
  constexpr double kDamping = 1e-6;
  Matrix8d A = n.information;
  for (int k = 0; k < 8; ++k) {
    if (k < parameters) {
      A(k, k) *= 1 + kDamping;
      continue;
    }
    A.row(k).setZero();
    A.col(k).setZero();
    A(k, k) = 1;
  }
  Vector8d b = n.gradient;
  b.tail(8 - parameters).setZero();
  const Eigen::LLT<Matrix8d> factored(A);
  if (factored.info() != Eigen::Success) return std::nullopt;
  const Vector8d step = factored.solve(b);
  return step.allFinite() ? std::optional<Vector8d>(step) : std::nullopt;
}

}  // namespace kestrel

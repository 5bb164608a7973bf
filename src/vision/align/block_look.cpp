#include "block_look.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/LU>

namespace kestrel {
namespace {

constexpr int kPixels = kernel::kBlockPixels;

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

/// What the kernels are told of the blocks of a level.
std::vector<kernel::Block> known(const BlockLevel& level) {
  std::vector<kernel::Block> blocks;
  for (std::size_t i = 0; i < level.blocks.size(); ++i) {
    blocks.push_back({float(level.blocks[i].u), float(level.blocks[i].v),
                      level.textures.data() + i * kPixels,
                      level.derivatives.data() + i * kPixels * kernel::kParameters});
  }
  return blocks;
}

/// Four points of a block whose mean and spread are those of its pixels, 8 x 8 of them: what a lens
/// bends over the block is then right in the mean, and the block is not shifted by it.
std::array<Pixel, 4> inner_points(const kernel::Block& block, const Eigen::Matrix3d& to) {
  constexpr double kMiddle = (kernel::kBlockSide - 1) / 2.0;
  const double spread = std::sqrt((kernel::kBlockSide * kernel::kBlockSide - 1) / 12.0);
  const std::array<std::array<double, 2>, 4> corners = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  std::array<Pixel, 4> points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p =
        to * Eigen::Vector3d(double(block.x) + kMiddle + spread * corners[i][0],
                             double(block.y) + kMiddle + spread * corners[i][1], 1);
    points[i] = {p.x() / p.z(), p.y() / p.z()};
  }
  return points;
}

}  // namespace

BlockLook::BlockLook(TemplateBlocks blocks, const AlignOptions& options)
    : all_(std::move(blocks)),
      options_(options),
      lens_(options.lens ? std::optional<BlockLens>(*options.lens) : std::nullopt),
      sample_(use_avx2(options.simd) ? kernel::sample_blocks_avx2 : kernel::sample_blocks_baseline),
      score_(use_avx2(options.simd) ? kernel::score_blocks_avx2 : kernel::score_blocks_baseline) {
  std::size_t most = 0;
  for (const BlockLevel& level : all_.levels) {
    blocks_.push_back(known(level));
    most = std::max(most, level.blocks.size());
  }
  sums_.resize(most);
  likeness_.reserve(most);
}

void BlockLook::look(kernel::SampleBlocks kernel_of, const ImagePyramid& image, const LevelPair& at,
                     const Homography& H) {
  if (lens_) return look_through_lens(kernel_of, image, at, H);
  const Eigen::Matrix3d G =
      level0_from_level(at.in_image).inverse() * H.H * level0_from_level(at.in_template);
  const Eigen::Matrix<float, 3, 3, Eigen::RowMajor> h = (G / G(2, 2)).cast<float>();
  const std::vector<kernel::Block>& blocks = blocks_[std::size_t(at.in_template)];
  kernel_of(sampled(image.level(at.in_image)), h.data(), blocks.data(), int(blocks.size()),
            sums_.data());
}

/// Each block by a homography of its own: the lens, straight over so few pixels.
void BlockLook::look_through_lens(kernel::SampleBlocks kernel_of, const ImagePyramid& image,
                                  const LevelPair& at, const Homography& H) {
  const std::vector<kernel::Block>& blocks = blocks_[std::size_t(at.in_template)];
  const Eigen::Matrix3d level_from_image = level0_from_level(at.in_image).inverse();
  const Eigen::Matrix3d straight_from_level = H.H * level0_from_level(at.in_template);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto bend = lens_->image_from_straight(inner_points(blocks[i], straight_from_level));
    sums_[i] = {};
    if (!bend) continue;
    const Eigen::Matrix3d G = level_from_image * *bend * straight_from_level;
    const Eigen::Matrix<float, 3, 3, Eigen::RowMajor> h = (G / G(2, 2)).cast<float>();
    kernel_of(sampled(image.level(at.in_image)), h.data(), &blocks[i], 1, &sums_[i]);
  }
}

Normal BlockLook::measured(const ImagePyramid& image, const LevelPair& at, const Homography& H) {
  look(sample_, image, at, H);
  return normal_equations(level(at), sums_, options_, all_.options);
}

double BlockLook::likeness(const ImagePyramid& image, const LevelPair& at, const Homography& H) {
  look(score_, image, at, H);
  const BlockLevel& known = level(at);
  double explained = 0;
  double all = 0;
  for (std::size_t i = 0; i < known.blocks.size(); ++i) {
    const double weight = std::sqrt(known.blocks[i].texture_norm2);
    all += weight;
    if (sums_[i].is_visible == 0) continue;
    const double c = std::max(zncc(known.blocks[i], sums_[i]), 0.0);
    explained += weight * c * c;
  }
  return all > 0 ? explained / all : 0;
}

Agreement BlockLook::agreement(const ImagePyramid& image, const LevelPair& at,
                               const Homography& H) {
  look(score_, image, at, H);
  return agreement_as_measured(at);
}

Agreement BlockLook::agreement_as_measured(const LevelPair& at) {
  const BlockLevel& known = level(at);
  likeness_.clear();
  for (std::size_t i = 0; i < known.blocks.size(); ++i) {
    const bool is_visible = sums_[i].is_visible != 0;
    likeness_.push_back({is_visible, is_visible ? zncc(known.blocks[i], sums_[i]) : 0});
  }
  return kestrel::agreement(likeness_, options_.agreement);
}

}  // namespace kestrel

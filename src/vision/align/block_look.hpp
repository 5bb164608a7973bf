#pragma once

#include <vector>

#include "kestrel/vision/agreement.hpp"
#include "kestrel/vision/align.hpp"
#include "kestrel/vision/image_pyramid.hpp"
#include "kestrel/vision/template_blocks.hpp"

#include "block_kernels.hpp"
#include "block_lens.hpp"
#include "level_pairs.hpp"
#include "normal_equations.hpp"

namespace kestrel {

/// Looks at frames with the blocks of a template, a level at a time. Places are those in the image
/// of the camera without its lens. Keeps its memory.
class BlockLook {
 public:
  BlockLook(TemplateBlocks blocks, const AlignOptions& options);
  BlockLook(BlockLook&&) noexcept = default;
  BlockLook& operator=(BlockLook&&) noexcept = default;
  BlockLook(const BlockLook&) = delete;  // the kernels are told where the pixels are
  BlockLook& operator=(const BlockLook&) = delete;
  ~BlockLook() = default;

  const TemplateBlocks& blocks() const { return all_; }

  /// The equations of a step from this place.
  Normal measured(const ImagePyramid& image, const LevelPair& at, const Homography& H);

  /// The share, 0 to 1, of the template's texture that the image shows at this place.
  double likeness(const ImagePyramid& image, const LevelPair& at, const Homography& H);

  /// How well the image agrees with this place.
  Agreement agreement(const ImagePyramid& image, const LevelPair& at, const Homography& H);

  /// The same for the place at which measured() has just been asked with that level.
  Agreement agreement_as_measured(const LevelPair& at);

 private:
  const BlockLevel& level(const LevelPair& at) const {
    return all_.levels[std::size_t(at.in_template)];
  }
  void look(kernel::SampleBlocks kernel_of, const ImagePyramid& image, const LevelPair& at,
            const Homography& H);
  void look_through_lens(kernel::SampleBlocks kernel_of, const ImagePyramid& image,
                         const LevelPair& at, const Homography& H);

  TemplateBlocks all_;
  AlignOptions options_;
  std::optional<BlockLens> lens_;
  kernel::SampleBlocks sample_;
  kernel::SampleBlocks score_;
  std::vector<std::vector<kernel::Block>> blocks_;  // by level
  std::vector<kernel::BlockSums> sums_;             // of the last look
  std::vector<BlockLikeness> likeness_;
};

}  // namespace kestrel

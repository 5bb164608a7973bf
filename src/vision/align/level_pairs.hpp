#pragma once

#include "kestrel/geometry/homography.hpp"
#include "kestrel/vision/image_pyramid.hpp"
#include "kestrel/vision/template_blocks.hpp"

namespace kestrel {

/// A level of the template and the level of the image that shows it at about the same size.
struct LevelPair {
  int in_template = 0;
  int in_image = 0;

  /// The pair coarser by so many octaves.
  LevelPair coarser(int octaves) const { return {in_template + octaves, in_image + octaves}; }
};

/// The template's size in the image over its size, from the areas; 1 when it is seen from behind.
double scale(const Homography& image_from_template, const TemplateBlocks& blocks);

/// The finest pair of levels whose sizes differ by less than a factor of sqrt(2).
LevelPair finest_pair(const Homography& image_from_template, const TemplateBlocks& blocks,
                      const ImagePyramid& image);

/// How many pairs there are, at least 1: the finest and those coarser by the same octaves of which
/// the template has blocks.
int pair_count(const LevelPair& finest, const TemplateBlocks& blocks, const ImagePyramid& image);

}  // namespace kestrel

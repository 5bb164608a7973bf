#include "level_pairs.hpp"

#include <algorithm>
#include <cmath>

namespace kestrel {

double scale(const Homography& H, const TemplateBlocks& blocks) {
  const double area = signed_area(outline(H, blocks.width, blocks.height));
  return area > 0 ? std::sqrt(area / ((blocks.width - 1) * (blocks.height - 1))) : 1;
}

LevelPair finest_pair(const Homography& H, const TemplateBlocks& blocks,
                      const ImagePyramid& image) {
  const int octaves = int(std::lround(std::log2(scale(H, blocks))));
  return {std::clamp(-octaves, 0, int(blocks.levels.size()) - 1),
          std::clamp(octaves, 0, image.levels() - 1)};
}

int pair_count(const LevelPair& finest, const TemplateBlocks& blocks, const ImagePyramid& image) {
  int count = 1;
  for (LevelPair next = finest.coarser(1);
       next.in_template < int(blocks.levels.size()) && next.in_image < image.levels() &&
       !blocks.levels[std::size_t(next.in_template)].blocks.empty();
       next = finest.coarser(count)) {
    ++count;
  }
  return count;
}

}  // namespace kestrel

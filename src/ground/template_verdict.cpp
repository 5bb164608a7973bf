#include "kestrel/ground/template_verdict.hpp"

#include <algorithm>
#include <array>

#include "kestrel/vision/self_likeness.hpp"

namespace kestrel {
namespace {

using Grade = TemplateVerdict::Grade;

double spread_of(const BlockLevel& level) {
  constexpr int kParts = 3;
  constexpr double kHalfBlock_px = 4;
  std::array<bool, std::size_t(kParts) * kParts> has{};
  const auto part = [](double at, int size) {
    return std::size_t(std::clamp(int(kParts * (at + kHalfBlock_px) / size), 0, kParts - 1));
  };
  for (const TemplateBlock& block : level.blocks) {
    has[part(block.v, level.height) * std::size_t(kParts) + part(block.u, level.width)] = true;
  }
  return double(std::count(has.begin(), has.end(), true)) / double(has.size());
}

TemplateVerdict graded(TemplateVerdict v, int needed_blocks) {
  v.grade = Grade::Poor;
  if (v.self_likeness >= kMuchLikeness) {
    v.words = "it repeats itself and may be mistaken for its neighbour; take in what is unique";
  } else if (v.spread <= 1.0 / 3) {
    v.words = "its texture is in one part only; draw the rectangle closer around the texture";
  } else if (v.blocks < 2 * needed_blocks) {
    v.words = "little texture; choose a larger or more textured part";
  } else {
    v.grade = Grade::Fair;
    v.words = v.self_likeness >= kSomeLikeness ? "parts of it repeat themselves"
                                               : "parts of it show nothing";
    if (v.self_likeness >= kSomeLikeness || v.spread < kSomeSpread) return v;
    v.grade = Grade::Good;
    v.words = "texture all over, and nowhere like itself";
  }
  return v;
}

}  // namespace

const char* name(TemplateVerdict::Grade grade) {
  switch (grade) {
    case Grade::Good:
      return "good";
    case Grade::Fair:
      return "fair";
    case Grade::Poor:
      return "poor";
  }
  return "unknown";
}

TemplateVerdict template_verdict(const Template& model, const TrackOptions& options) {
  const TemplateBlocks blocks = template_blocks(model.picture(), options.blocks);
  const SelfLikeness likeness = self_likeness(model.picture(), blocks, options.align);
  TemplateVerdict v;
  v.keypoints =
      int(std::max(model.keypoints().at.size(), model.features().at.size()));  // of its method
  v.self_likeness = likeness.share;
  v.likeness_places = int(likeness.places.size());
  if (!blocks.levels.empty()) {
    v.blocks = int(blocks.levels.front().blocks.size());
    v.spread = spread_of(blocks.levels.front());
  }
  return graded(v, options.align.agreement.min_alike);
}

}  // namespace kestrel

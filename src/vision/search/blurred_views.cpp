#include "blurred_views.hpp"

#include <algorithm>

namespace kestrel {
namespace {

constexpr std::size_t kStarts = 2;

/// Views that are aligned from one start: of those 30 degrees or a factor of 1.5 apart four are
/// next to each other.
constexpr std::size_t kTried = 4;

}  // namespace

BlurredViews::BlurredViews(const Template& model, const AlignOptions& options) {
  for (const TemplateBlocks& blocks : model.blurred()) views_.emplace_back(blocks, options);
  guesses_.reserve(kStarts * views_.size());
}

const std::vector<BlurredViews::Guess>& BlurredViews::likeliest(
    const ImagePyramid& image, std::initializer_list<Homography> starts) {
  guesses_.clear();
  for (std::size_t i = 0; i < views_.size(); ++i) {
    for (const Homography& start : starts) {
      guesses_.push_back({i, start, views_[i].detail(image, start)});
    }
  }
  const auto kept = std::min(guesses_.size(), kTried * starts.size());
  const auto end = guesses_.begin() + std::ptrdiff_t(kept);
  std::partial_sort(guesses_.begin(), end, guesses_.end(), [](const Guess& a, const Guess& b) {
    return a.likeness != b.likeness ? a.likeness > b.likeness : a.view < b.view;
  });
  guesses_.resize(kept);
  return guesses_;
}

}  // namespace kestrel

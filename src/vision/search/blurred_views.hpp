#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <vector>

#include "kestrel/vision/align.hpp"
#include "kestrel/vision/image_pyramid.hpp"
#include "kestrel/vision/template.hpp"

namespace kestrel {

/// The template as blur shows it, view by view. Allocates nothing after it is made.
class BlurredViews {
 public:
  /// Of model.blurred(), for up to two starts at a time.
  BlurredViews(const Template& model, const AlignOptions& options);

  /// A view, and a place to align it from.
  struct Guess {
    std::size_t view = 0;
    Homography start;
    double likeness = 0;  // share of the view's texture that the image shows at the start, 0 to 1
  };

  bool empty() const { return views_.empty(); }

  /// Of all views at each of the starts the likeliest, at most so many for each start, best first.
  /// Valid until the next call.
  const std::vector<Guess>& likeliest(const ImagePyramid& image,
                                      std::initializer_list<Homography> starts);

  std::optional<Alignment> align(const ImagePyramid& image, const Guess& guess) {
    return views_[guess.view].align(image, guess.start);
  }

 private:
  std::vector<Aligner> views_;
  std::vector<Guess> guesses_;
};

}  // namespace kestrel

#pragma once

#include <cmath>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "svg_parts.hpp"

namespace kestrel::svg {

/// Keeps words of a picture from standing on one another.
class FreeWords {
 public:
  /// Takes the first of these places where the word meets none that stands already; the last one
  /// when it meets others in all. A place is the middle of the word and its baseline, px.
  Eigen::Vector2d place(std::string_view word, const std::vector<Eigen::Vector2d>& places) {
    const double width = text_width(word);
    for (const Eigen::Vector2d& at : places) {
      if (&at != &places.back() && !is_free(at, width)) continue;
      taken_.push_back({at, width});
      return at;
    }
    return Eigen::Vector2d::Zero();  // no places
  }

 private:
  static constexpr double kHeight_px = 12;
  struct Word {
    Eigen::Vector2d at;
    double width;
  };

  bool is_free(const Eigen::Vector2d& at, double width) const {
    for (const Word& word : taken_) {
      const Eigen::Vector2d apart = (word.at - at).cwiseAbs();
      if (apart.x() < (word.width + width) / 2 && apart.y() < kHeight_px) return false;
    }
    return true;
  }

  std::vector<Word> taken_;
};

}  // namespace kestrel::svg

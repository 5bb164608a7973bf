#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "../kernels/kernels.hpp"
#include "gaussian_taps.hpp"

namespace kestrel::sift {

/// Rows of floats; the last rows only when there are fewer than the image has.
struct Plane {
  float* first = nullptr;
  int stride = 0;
  int mask = ~0;  // of the row's number

  float* row(int y) const { return first + std::ptrdiff_t(y & mask) * stride; }
};

/// A pixel of a difference of Gaussians that is extreme among its neighbours.
struct Candidate {
  int layer = 0;
  int u = 0;  // px of the octave
  int v = 0;
};

/// What the first octave is made of: 8-bit pixels, as they are or enlarged twice.
struct Picture {
  cv::Mat gray;
  bool is_doubled = false;

  int width() const { return is_doubled ? 2 * gray.cols : gray.cols; }
  int height() const { return is_doubled ? 2 * gray.rows : gray.rows; }
};

/// How an octave's levels follow from each other.
struct Ladder {
  int layers = 3;
  int threshold = 0;                // of candidates, 1/kDogScale grey levels
  std::vector<GaussianTaps> blurs;  // layers + 3: to each level from the one before
  const kernels::Table* kernels = nullptr;
};

/// One octave of the scale space: layers + 3 levels of blur and the extrema of their differences.
/// All levels advance together, a row at a time, while the rows they need are in the cache.
class Octave {
 public:
  /// From pixels: level 0 is their blur.
  void build(const Picture& picture, const Ladder& ladder);
  /// From every second pixel of the level of the octave before that has twice the blur.
  void build(const Octave& before, const Ladder& ladder);

  int width() const { return width_; }
  int height() const { return height_; }
  const Plane& level(int i) const { return levels_[std::size_t(i)]; }
  const std::vector<Candidate>& candidates() const { return candidates_; }

  /// Extrema are looked for this far from the border: refining may move them.
  static constexpr int kBorderPx = 5;

 private:
  void shape(int width, int height, const Ladder& ladder);
  void advance(const Ladder& ladder, int first_level);
  void blur_row(const Ladder& ladder, int level, int v);
  void search_row(const Ladder& ladder, int v);
  bool can_advance(const GaussianTaps& blur, int level) const;
  int done(int level) const { return done_[std::size_t(level + 1)]; }
  const Plane& above(int level) const {
    return level == 0 ? source_ : levels_[std::size_t(level - 1)];
  }

  int width_ = 0;
  int height_ = 0;
  int stride_ = 0;
  std::vector<float> floats_;       // storage of the planes
  std::vector<std::int16_t> dogs_;  // kDogRows rows of each difference
  std::vector<std::int16_t> extremes_;
  std::vector<float> scratch_;
  std::vector<std::int32_t> found_;
  Plane source_;
  std::vector<Plane> levels_;
  std::vector<int> done_;  // rows, of the source and each level
  int differed_ = 0;       // rows
  std::vector<Candidate> candidates_;
};

}  // namespace kestrel::sift

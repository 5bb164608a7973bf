#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "../kernels/kernels.hpp"
#include "gaussian_taps.hpp"
#include "plane.hpp"
#include "refine.hpp"

namespace kestrel::sift {

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
  Refinement wanted;
  std::vector<GaussianTaps> blurs;  // layers + 3: to each level from the one before
  const kernels::Table* kernels = nullptr;
};

/// One octave of the scale space: layers + 3 levels of blur and the extrema of their differences.
/// All advance together, a few rows at a time, while the rows they need are in the cache; only the
/// levels that keypoints are described from are kept whole.
class Octave {
 public:
  /// From pixels: level 0 is their blur.
  void build(const Picture& picture, const Ladder& ladder);
  /// From every second pixel of the level of the octave before that has twice the blur.
  void build(const Octave& before, const Ladder& ladder);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Levels 1 to layers, in units of 1/kFixedScale grey levels.
  const Plane<std::int16_t>& level(int i) const { return fixed_[std::size_t(i)]; }
  const std::vector<Extremum>& extrema() const { return extrema_; }

 private:
  void shape(int width, int height, const Ladder& ladder);
  void shape_planes(const Ladder& ladder);
  void advance(const Ladder& ladder);
  void blur(const Ladder& ladder, int level);
  void search_rows(const Ladder& ladder);
  void search_row(const Ladder& ladder, int v);
  void refine(const Ladder& ladder, int rows_done);
  bool is_known(const Extremum& extremum) const;
  int ready(const Ladder& ladder, int level) const;
  int& done(int level) { return done_[std::size_t(level) + 1]; }
  int done(int level) const { return done_[std::size_t(level) + 1]; }
  const Plane<float>& before(int level) const {
    return level == 0 ? source_ : levels_[std::size_t(level) - 1];
  }

  int width_ = 0;
  int height_ = 0;
  int stride_ = 0;
  Plane<float> source_;
  std::vector<Plane<float>> levels_;
  std::vector<Plane<std::int16_t>> fixed_;  // the same rounded to 16 bits
  std::vector<float> scratch_;
  std::vector<std::int16_t> extremes_;
  std::vector<std::int32_t> found_;
  std::vector<int> done_;  // rows, of the source and each level
  int searched_ = 0;       // rows
  std::vector<Candidate> candidates_;
  std::size_t refined_ = 0;  // candidates
  std::vector<Extremum> extrema_;
  std::vector<int> last_in_column_;  // index of the last extremum of a column of pixels, or -1
};

}  // namespace kestrel::sift

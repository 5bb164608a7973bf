#include "octave.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace kestrel::sift {
namespace {

using kernels::kBandRows;
using kernels::kRowBlock;

int rounded_up(int x, int block) { return (x + block - 1) / block * block; }

int reach(const GaussianTaps& blur) { return blur.radius * blur.step; }

/// Twice as wide: even pixels are those of the row, odd ones between their neighbours.
void double_row(const float* in, int width, float* out) {
  for (std::ptrdiff_t x = 0; x + 1 < width; ++x) {
    out[2 * x] = in[x];
    out[2 * x + 1] = 0.5F * (in[x] + in[x + 1]);
  }
  const std::ptrdiff_t end = 2 * std::ptrdiff_t(width);
  out[end - 2] = out[end - 1] = in[width - 1];
}

void fill_row(const Picture& picture, const kernels::Table& kernels, int v, float* scratch,
              float* out) {
  const int width = picture.gray.cols;
  if (!picture.is_doubled) return kernels.widen(picture.gray.ptr(v), out, width);
  const int below = std::min(v / 2 + v % 2, picture.gray.rows - 1);
  kernels.widen(picture.gray.ptr(v / 2), scratch, width);
  kernels.widen(picture.gray.ptr(below), scratch + width, width);
  for (int x = 0; x < width; ++x) scratch[x] = 0.5F * (scratch[x] + scratch[width + x]);
  double_row(scratch, width, out);
}

}  // namespace

void Octave::shape(int width, int height, const Ladder& ladder) {
  width_ = width;
  height_ = height;
  stride_ = rounded_up(width, kRowBlock) + 2 * kernels::kRowMargin;
  shape_planes(ladder);
  const std::size_t stride = std::size_t(stride_);
  const std::size_t count = fixed_.size();
  const auto at_least = [](auto& storage, std::size_t size) {
    if (storage.size() < size) storage.resize(size);
  };
  at_least(scratch_, kBandRows * stride);
  at_least(extremes_, 3 * count * stride + 2 * std::size_t(kRowBlock));
  at_least(found_, count * stride);
  done_.assign(count + 1, 0);
  searched_ = 0;
  candidates_.clear();
  refined_ = 0;
  extrema_.clear();
  last_in_column_.assign(std::size_t(width), -1);
}

/// A ring of rows holds what is still to be read: by the next blur or by the search and the
/// refinement, which wait for the last level.
void Octave::shape_planes(const Ladder& ladder) {
  const int count = ladder.layers + 3;
  levels_.resize(std::size_t(count));
  fixed_.resize(std::size_t(count));
  source_.shape(height_, 2 * reach(ladder.blurs[0]) + 2 * kBandRows, stride_);
  int lead = 2 * kBandRows + 2 * kRefineReachPx + 2;
  for (int i = count - 1; i >= 0; --i) {
    const bool is_kept = i >= 1 && i <= ladder.layers;
    const int ahead = i + 1 < count ? reach(ladder.blurs[std::size_t(i) + 1]) : 0;
    lead += ahead;
    levels_[std::size_t(i)].shape(height_, 2 * ahead + 2 * kBandRows, stride_);
    fixed_[std::size_t(i)].shape(height_, is_kept ? height_ : lead, stride_);
  }
}

void Octave::build(const Picture& picture, const Ladder& ladder) {
  shape(picture.width(), picture.height(), ladder);
  while (done(-1) < height_) {
    const int end = std::min(done(-1) + kBandRows, height_);
    for (int& v = done(-1); v < end; ++v)
      fill_row(picture, *ladder.kernels, v, scratch_.data(), source_.row(v));
    advance(ladder);
  }
}

void Octave::build(const Octave& octave_before, const Ladder& ladder) {
  shape((octave_before.width() + 1) / 2, (octave_before.height() + 1) / 2, ladder);
  while (done(0) < height_) {
    const int end = std::min(done(0) + kBandRows, height_);
    for (int& v = done(0); v < end; ++v) {
      ladder.kernels->halve(octave_before.level(ladder.layers).row(2 * v), levels_[0].row(v),
                            fixed_[0].row(v), width_);
    }
    advance(ladder);
  }
}

/// Rows of a level that can be made from those of the level before.
int Octave::ready(const Ladder& ladder, int level) const {
  const int above = done(level - 1);
  if (above == height_) return height_;
  return std::max(above - reach(ladder.blurs[std::size_t(level)]), 0);
}

void Octave::advance(const Ladder& ladder) {
  // A ring has room for one band more than is read: levels take turns, band by band.
  for (bool is_moving = true; is_moving;) {
    is_moving = false;
    for (int i = 0; i < int(levels_.size()); ++i) {
      if (done(i) >= ready(ladder, i)) continue;
      blur(ladder, i);
      is_moving = true;
    }
    search_rows(ladder);
  }
}

void Octave::blur(const Ladder& ladder, int level) {
  const GaussianTaps& taps = ladder.blurs[std::size_t(level)];
  const int first = done(level);
  const int count = std::min(ready(ladder, level) - first, kBandRows);
  const int last_level = int(levels_.size()) - 1;
  kernels::BlurBand band{};
  band.rows = before(level).rows(first - reach(taps));
  band.taps = taps.taps.data();
  band.radius = taps.radius;
  band.step = taps.step;
  band.scratch = scratch_.data();
  band.stride = stride_;
  band.count = count;
  band.width = width_;
  band.out = level == last_level ? nullptr : levels_[std::size_t(level)].rows(first);
  band.fixed = fixed_[std::size_t(level)].rows(first);
  ladder.kernels->blur(band);
  done(level) += count;
}

void Octave::search_rows(const Ladder& ladder) {
  const int last = done(int(levels_.size()) - 1);
  // The row below must be there; the image's last row is not searched.
  for (; searched_ < std::min(last, height_) - 1; ++searched_) search_row(ladder, searched_);
  refine(ladder, last);
}

void Octave::search_row(const Ladder& ladder, int v) {
  if (v < kBorderPx || v >= height_ - kBorderPx || width_ <= 2 * kBorderPx) return;
  std::array<const std::int16_t*, 3 * std::size_t(kernels::kMaxLevels)> rows{};
  const int count = int(fixed_.size());
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k)
      rows[3 * std::size_t(i) + std::size_t(k)] = fixed_[std::size_t(i)].row(v - 1 + k);
  }
  const int threshold = int(0.5 * ladder.wanted.contrast * double(kernels::kFixedScale));
  const int found =
      ladder.kernels->find_extrema({rows.data(), count, kBorderPx, width_ - kBorderPx, threshold,
                                    extremes_.data() + kRowBlock, stride_, found_.data()});
  for (int k = 0; k < found; ++k) {
    const std::int32_t key = found_[std::size_t(k)];
    candidates_.push_back({key >> 16, key & 0xffff, v});
  }
}

/// Two candidates may lead to one extremum.
bool Octave::is_known(const Extremum& extremum) const {
  const float u = float(extremum.at.u) + extremum.du;
  const float v = float(extremum.at.v) + extremum.dv;
  const float layer = float(extremum.at.layer) + extremum.dlayer;
  for (int column = extremum.at.u - 1; column <= extremum.at.u + 1; ++column) {
    const int i = last_in_column_[std::size_t(column)];
    if (i < 0) continue;
    const Extremum& other = extrema_[std::size_t(i)];
    constexpr float kSame = 0.3F;
    if (std::abs(float(other.at.u) + other.du - u) < kSame &&
        std::abs(float(other.at.v) + other.dv - v) < kSame &&
        std::abs(float(other.at.layer) + other.dlayer - layer) < kSame)
      return true;
  }
  return false;
}

/// Candidates whose neighbourhood is there.
void Octave::refine(const Ladder& ladder, int rows_done) {
  const Levels levels{fixed_.data(), width_, height_, ladder.layers};
  for (; refined_ < candidates_.size(); ++refined_) {
    const Candidate& candidate = candidates_[refined_];
    if (candidate.v + kRefineReachPx >= rows_done && rows_done < height_) return;
    const auto extremum = refined(levels, candidate, ladder.wanted);
    if (!extremum || is_known(*extremum)) continue;
    last_in_column_[std::size_t(extremum->at.u)] = int(extrema_.size());
    extrema_.push_back(*extremum);
  }
}

}  // namespace kestrel::sift

#include "octave.hpp"

#include <algorithm>
#include <array>

namespace kestrel::sift {
namespace {

constexpr int kSourceRows = 32;  // kept: more than 2 kMaxRadius + 1, a power of two
constexpr int kDogRows = 4;
constexpr int kTail = 64;  // floats a kernel may read past the last row

int rounded_up(int x, int block) { return (x + block - 1) / block * block; }

/// -1 is 1, size is size - 2.
int mirrored(int i, int size) {
  if (size == 1) return 0;
  const int period = 2 * (size - 1);
  const int j = ((i % period) + period) % period;
  return j < size ? j : period - j;
}

/// Twice as wide: even pixels are those of the row, odd ones between their neighbours.
void double_row(const float* in, int width, float* out) {
  for (int x = 0; x + 1 < width; ++x) {
    out[2 * x] = in[x];
    out[2 * x + 1] = 0.5F * (in[x] + in[x + 1]);
  }
  out[2 * width - 2] = out[2 * width - 1] = in[width - 1];
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
  using kernels::kRowBlock;
  width_ = width;
  height_ = height;
  stride_ = rounded_up(width, kRowBlock) + 2 * kRowBlock;
  const std::size_t count = std::size_t(ladder.layers) + 3;
  const std::size_t rows = count * std::size_t(height) + kSourceRows;
  const std::size_t stride = std::size_t(stride_);
  const auto at_least = [](auto& storage, std::size_t size) {
    if (storage.size() < size) storage.resize(size);
  };
  at_least(floats_, rows * stride + kTail);
  at_least(scratch_, stride + 2 * kernels::kRowMargin);
  at_least(dogs_, (count - 1) * kDogRows * stride);
  at_least(extremes_, 2 * count * stride + kRowBlock);
  at_least(found_, count * stride);
  source_ = {floats_.data(), stride_, kSourceRows - 1};
  levels_.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    levels_[i] = {floats_.data() + (kSourceRows + i * std::size_t(height)) * stride, stride_, ~0};
  done_.assign(count + 1, 0);
  differed_ = 0;
  candidates_.clear();
}

void Octave::build(const Picture& picture, const Ladder& ladder) {
  shape(picture.width(), picture.height(), ladder);
  for (int v = 0; v < height_; ++v) {
    fill_row(picture, *ladder.kernels, v, scratch_.data(), source_.row(v));
    ++done_[0];
    advance(ladder, 0);
  }
}

void Octave::build(const Octave& before, const Ladder& ladder) {
  shape((before.width() + 1) / 2, (before.height() + 1) / 2, ladder);
  done_[0] = height_;
  for (int v = 0; v < height_; ++v) {
    const float* const from = before.level(ladder.layers).row(2 * v);
    float* const to = levels_[0].row(v);
    for (int u = 0; u < width_; ++u) to[u] = from[2 * u];
    ++done_[1];
    advance(ladder, 1);
  }
}

bool Octave::can_advance(const GaussianTaps& blur, int level) const {
  const int next = done(level);
  return next < height_ &&
         (done(level - 1) == height_ || next + blur.radius * blur.step < done(level - 1));
}

void Octave::advance(const Ladder& ladder, int first_level) {
  const int count = int(levels_.size());
  for (int i = first_level; i < count; ++i) {
    while (can_advance(ladder.blurs[std::size_t(i)], i)) {
      blur_row(ladder, i, done(i));
      ++done_[std::size_t(i + 1)];
    }
  }
  for (; differed_ < done(count - 1); ++differed_) {
    search_row(ladder, differed_);
  }
}

void Octave::blur_row(const Ladder& ladder, int level, int v) {
  const GaussianTaps& blur = ladder.blurs[std::size_t(level)];
  std::array<const float*, 2 * kernels::kMaxRadius + 1> rows{};
  for (int i = -blur.radius; i <= blur.radius; ++i)
    rows[std::size_t(i + blur.radius)] = above(level).row(mirrored(v + i * blur.step, height_));
  ladder.kernels->blur_row({rows.data(), blur.taps.data(), blur.radius, blur.step, scratch_.data(),
                            levels_[std::size_t(level)].row(v), width_});
}

/// Takes the differences of row v, then looks for extrema in the row above it.
void Octave::search_row(const Ladder& ladder, int v) {
  const int count = int(levels_.size()) - 1;
  const auto dog = [this](int i, int row) {
    return dogs_.data() + std::ptrdiff_t(i * kDogRows + row % kDogRows) * stride_;
  };
  std::array<const float*, kernels::kMaxDogs + 1> levels{};
  std::array<std::int16_t*, kernels::kMaxDogs> written{};
  for (int i = 0; i <= count; ++i) levels[std::size_t(i)] = level(i).row(v);
  for (int i = 0; i < count; ++i) written[std::size_t(i)] = dog(i, v);
  ladder.kernels->difference_rows(levels.data(), written.data(), count, width_);
  const int at = v - 1;
  if (at < kBorderPx || at >= height_ - kBorderPx || width_ <= 2 * kBorderPx) return;
  std::array<const std::int16_t*, 3 * kernels::kMaxDogs> read{};
  for (int i = 0; i < 3 * count; ++i) read[std::size_t(i)] = dog(i / 3, v - 2 + i % 3);
  const int found = ladder.kernels->find_extrema(
      {read.data(), count, kBorderPx, width_ - kBorderPx, ladder.threshold,
       extremes_.data() + kernels::kRowBlock, stride_, found_.data()});
  for (int k = 0; k < found; ++k) {
    const std::int32_t key = found_[std::size_t(k)];
    candidates_.push_back({key >> 16, key & 0xffff, at});
  }
}

}  // namespace kestrel::sift

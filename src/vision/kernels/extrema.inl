// Extrema of the differences of Gaussians, in 16 bits.
namespace kestrel::kernels::KESTREL_KERNELS {
namespace {

/// Scratch rows 3i and 3i + 1: the largest and the smallest of differences i..i+2 in a column of
/// three rows; 3i + 2: difference i + 1 itself.
template <int Layers>
void column_extremes(const ExtremaRow& row, int begin, int end) {
  constexpr int kDogs = Layers + 2;
  for (int x = begin; x < end; x += kShortLanes) {
    Shorts at[kDogs];
    Shorts high[kDogs];
    Shorts low[kDogs];
    for (int i = 0; i < kDogs; ++i) {
      const std::int16_t* const* const from = row.levels + 3 * i;
      const Shorts above = shorts(from[3] + x) - shorts(from[0] + x);
      const Shorts below = shorts(from[5] + x) - shorts(from[2] + x);
      at[i] = shorts(from[4] + x) - shorts(from[1] + x);
      high[i] = larger(larger(above, below), at[i]);
      low[i] = smaller(smaller(above, below), at[i]);
    }
    std::int16_t* out = row.scratch + x;
    for (int i = 0; i < Layers; ++i, out += 3 * row.stride) {
      store(out, larger(larger(high[i], high[i + 2]), high[i + 1]));
      store(out + row.stride, smaller(smaller(low[i], low[i + 2]), low[i + 1]));
      store(out + 2 * row.stride, at[i + 1]);
    }
  }
}

/// Lanes where the difference is the largest or the smallest of its neighbourhood and strong.
inline unsigned extreme_lanes(Shorts at, const std::int16_t* high, const std::int16_t* low,
                              Shorts threshold) {
  const Shorts highest = larger(larger(shorts(high - 1), shorts(high + 1)), shorts(high));
  const Shorts lowest = smaller(smaller(shorts(low - 1), shorts(low + 1)), shorts(low));
  const Shorts is_top = (at >= highest) & (at > threshold);
  const Shorts is_bottom = (at <= lowest) & (at < -threshold);
  return mask_of(is_top | is_bottom);
}

int find_extrema(const ExtremaRow& row) {
  const int begin = row.begin / kShortLanes * kShortLanes;
  const int before = begin == 0 ? 0 : begin - kShortLanes;
  const int after = row.end + kShortLanes;
  using Extremes = void (*)(const ExtremaRow&, int, int);
  static constexpr Extremes kExtremes[] = {column_extremes<1>, column_extremes<2>,
                                           column_extremes<3>, column_extremes<4>,
                                           column_extremes<5>};
  const int layers = row.count - 3;
  kExtremes[layers - 1](row, before, after);
  const Shorts threshold = all(std::int16_t(row.threshold));
  int found = 0;
  for (int i = 0; i < layers; ++i) {
    const std::int16_t* const high = row.scratch + 3 * i * row.stride;
    const std::int16_t* const low = high + row.stride;
    const std::int16_t* const at = low + row.stride;
    for (int x = begin; x < row.end; x += kShortLanes) {
      unsigned mask = extreme_lanes(shorts(at + x), high + x, low + x, threshold);
      for (; mask != 0; mask &= mask - 1, mask &= mask - 1) {
        const int column = x + __builtin_ctz(mask) / 2;
        if (column >= row.begin && column < row.end) row.found[found++] = (i + 1) << 16 | column;
      }
    }
  }
  return found;
}

}  // namespace
}  // namespace kestrel::kernels::KESTREL_KERNELS

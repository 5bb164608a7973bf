// Differences of Gaussians and their extrema, in 16 bits.
namespace kestrel::kernels::KESTREL_KERNELS {
namespace {

void difference_rows(const float* const* levels, std::int16_t* const* dogs, int dogs_count,
                     int width) {
  for (int x = 0; x < width; x += kShortLanes) {
    Floats low = floats(levels[0] + x);
    Floats high = floats(levels[0] + x + kLanes);
    for (int i = 0; i < dogs_count; ++i) {
      const Floats next_low = floats(levels[i + 1] + x);
      const Floats next_high = floats(levels[i + 1] + x + kLanes);
      store(dogs[i] + x, packed(rounded((next_low - low) * kDogScale),
                                rounded((next_high - high) * kDogScale)));
      low = next_low;
      high = next_high;
    }
  }
}

/// Largest and smallest of three rows of each difference, then of three neighbouring differences:
/// scratch row 2i is the largest of differences i..i+2 in a column, 2i + 1 the smallest.
template <int Count>
void column_extremes(const ExtremaRow& row, int begin, int end) {
  for (int x = begin; x < end; x += kShortLanes) {
    Shorts high[Count];
    Shorts low[Count];
    for (int i = 0; i < Count; ++i) {
      const Shorts above = shorts(row.dogs[3 * i] + x);
      const Shorts at = shorts(row.dogs[3 * i + 1] + x);
      const Shorts below = shorts(row.dogs[3 * i + 2] + x);
      high[i] = larger(larger(above, below), at);
      low[i] = smaller(smaller(above, below), at);
    }
    for (int i = 0; i + 2 < Count; ++i) {
      store(row.scratch + 2 * i * row.stride + x, larger(larger(high[i], high[i + 2]), high[i + 1]));
      store(row.scratch + (2 * i + 1) * row.stride + x,
            smaller(smaller(low[i], low[i + 2]), low[i + 1]));
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
  static constexpr Extremes kExtremes[] = {column_extremes<3>, column_extremes<4>,
                                           column_extremes<5>, column_extremes<6>,
                                           column_extremes<7>, column_extremes<8>};
  kExtremes[row.count - 3](row, before, after);
  const Shorts threshold = all(std::int16_t(row.threshold));
  int found = 0;
  for (int i = 0; i + 2 < row.count; ++i) {
    const std::int16_t* const high = row.scratch + 2 * i * row.stride;
    const std::int16_t* const low = high + row.stride;
    const std::int16_t* const at = row.dogs[3 * (i + 1) + 1];
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

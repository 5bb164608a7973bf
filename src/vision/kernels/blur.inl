// Separable blur of some rows at a time.
namespace kestrel::kernels::KESTREL_KERNELS {
namespace {

void widen(const std::uint8_t* in, float* out, int count) {
  for (int i = 0; i < count; ++i) out[i] = float(in[i]);
}

void halve(const std::int16_t* in, float* out, std::int16_t* fixed, int count) {
  for (int x = 0; x < count; x += kShortLanes) {
    const Ints low = (load<Ints>(in + 2 * x) << 16) >> 16;
    const Ints high = (load<Ints>(in + 2 * x + kShortLanes) << 16) >> 16;
    store(out + x, __builtin_convertvector(low, Floats) * (1 / kFixedScale));
    store(out + x + kLanes, __builtin_convertvector(high, Floats) * (1 / kFixedScale));
    store(fixed + x, packed(low, high));
  }
}

/// Columns are blurred so many px at a time that the rows' parts stay in the first cache.
constexpr int kColumnBlock = 64;

template <int Radius>
void blur_columns(const BlurBand& band, int row, int begin, int end) {
  Floats taps[Radius + 1];
  for (int i = 0; i <= Radius; ++i) taps[i] = all(band.taps[i]);
  const float* in[2 * Radius + 1];
  for (int i = 0; i <= 2 * Radius; ++i) in[i] = band.rows[row + i * band.step];
  float* const out = band.scratch + row * band.stride + kRowMargin;
  for (int x = begin; x < end; x += kLanes) {
    Floats sum = taps[0] * floats(in[Radius] + x);
    for (int i = 1; i <= Radius; ++i)
      sum += taps[i] * (floats(in[Radius - i] + x) + floats(in[Radius + i] + x));
    store(out + x, sum);
  }
}

template <int Radius, int Step>
inline Floats along(const Floats (&taps)[Radius + 1], const float* in) {
  Floats sum = taps[0] * floats(in);
  for (int i = 1; i <= Radius; ++i) sum += taps[i] * (floats(in - i * Step) + floats(in + i * Step));
  return sum;
}

template <int Radius, int Step>
void blur_along(const BlurBand& band, int row) {
  Floats taps[Radius + 1];
  for (int i = 0; i <= Radius; ++i) taps[i] = all(band.taps[i]);
  const float* const in = band.scratch + row * band.stride + kRowMargin;
  float* const out = band.out == nullptr ? nullptr : band.out[row];
  std::int16_t* const fixed = band.fixed[row];
  for (int x = 0; x < band.width; x += kShortLanes) {
    const Floats low = along<Radius, Step>(taps, in + x);
    const Floats high = along<Radius, Step>(taps, in + x + kLanes);
    if (out != nullptr) {
      store(out + x, low);
      store(out + x + kLanes, high);
    }
    store(fixed + x, packed(rounded(low * kFixedScale), rounded(high * kFixedScale)));
  }
}

/// Index of a mirrored pixel: -1 is 1, size is size - 2.
inline int mirrored(int i, int size) {
  if (size == 1) return 0;
  const int period = 2 * (size - 1);
  i %= period;
  if (i < 0) i += period;
  return i < size ? i : period - i;
}

void mirror_ends(float* in, int width, int reach) {
  if (width > reach) {
    for (int i = 1; i <= reach; ++i) {
      in[-i] = in[i];
      in[width - 1 + i] = in[width - 1 - i];
    }
    return;
  }
  for (int i = 1; i <= reach; ++i) {
    in[-i] = in[mirrored(-i, width)];
    in[width - 1 + i] = in[mirrored(width - 1 + i, width)];
  }
}

template <int Radius, int Step>
void blur_band(const BlurBand& band) {
  for (int x = 0; x < band.width; x += kColumnBlock) {
    const int end = x + kColumnBlock < band.width ? x + kColumnBlock : band.width;
    for (int row = 0; row < band.count; ++row) blur_columns<Radius>(band, row, x, end);
  }
  for (int row = 0; row < band.count; ++row) {
    mirror_ends(band.scratch + row * band.stride + kRowMargin, band.width, Radius * Step);
    blur_along<Radius, Step>(band, row);
  }
}

template <int Radius>
void blur_with(const BlurBand& band) {
  if (band.step == 1) blur_band<Radius, 1>(band);
  if (band.step == 2) blur_band<Radius, 2>(band);
  if (band.step == 3) blur_band<Radius, 3>(band);
}

void blur(const BlurBand& band) {
  using Blur = void (*)(const BlurBand&);
  static constexpr Blur kBlurs[] = {blur_with<1>, blur_with<2>, blur_with<3>, blur_with<4>,
                                    blur_with<5>, blur_with<6>, blur_with<7>, blur_with<8>,
                                    blur_with<9>, blur_with<10>};
  kBlurs[band.radius - 1](band);
}

}  // namespace
}  // namespace kestrel::kernels::KESTREL_KERNELS

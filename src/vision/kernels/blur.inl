// Separable blur of a row, after the columns.
namespace kestrel::kernels::KESTREL_KERNELS {
namespace {

void widen(const std::uint8_t* in, float* out, int count) {
  for (int i = 0; i < count; ++i) out[i] = float(in[i]);
}

template <int Radius>
void blur_columns(const BlurRow& row, float* out) {
  Floats taps[Radius + 1];
  for (int i = 0; i <= Radius; ++i) taps[i] = all(row.taps[i]);
  const float* const* rows = row.rows + Radius;
  for (int x = 0; x < row.width; x += kLanes) {
    Floats sum = taps[0] * floats(rows[0] + x);
    for (int i = 1; i <= Radius; ++i) sum += taps[i] * (floats(rows[-i] + x) + floats(rows[i] + x));
    store(out + x, sum);
  }
}

template <int Radius, int Step>
void blur_along(const BlurRow& row, const float* in) {
  Floats taps[Radius + 1];
  for (int i = 0; i <= Radius; ++i) taps[i] = all(row.taps[i]);
  for (int x = 0; x < row.width; x += kLanes) {
    Floats sum = taps[0] * floats(in + x);
    for (int i = 1; i <= Radius; ++i)
      sum += taps[i] * (floats(in + x - i * Step) + floats(in + x + i * Step));
    store(row.out + x, sum);
  }
}

/// Index of a mirrored row: -1 is 1, size is size - 2.
inline int mirrored(int i, int size) {
  if (size == 1) return 0;
  const int period = 2 * (size - 1);
  i %= period;
  if (i < 0) i += period;
  return i < size ? i : period - i;
}

void mirror_ends(float* in, int width, int reach) {
  for (int i = 1; i <= reach; ++i) {
    in[-i] = in[mirrored(-i, width)];
    in[width - 1 + i] = in[mirrored(width - 1 + i, width)];
  }
}

template <int Radius>
void blur(const BlurRow& row) {
  float* const between = row.scratch + kRowMargin;
  blur_columns<Radius>(row, between);
  mirror_ends(between, row.width, Radius * row.step);
  if (row.step == 1) blur_along<Radius, 1>(row, between);
  if (row.step == 2) blur_along<Radius, 2>(row, between);
  if (row.step == 3) blur_along<Radius, 3>(row, between);
}

void blur_row(const BlurRow& row) {
  using Blur = void (*)(const BlurRow&);
  static constexpr Blur kBlurs[] = {blur<1>, blur<2>, blur<3>, blur<4>, blur<5>,
                                    blur<6>, blur<7>, blur<8>, blur<9>, blur<10>};
  kBlurs[row.radius - 1](row);
}

}  // namespace
}  // namespace kestrel::kernels::KESTREL_KERNELS

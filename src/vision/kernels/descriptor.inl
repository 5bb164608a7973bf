// SIFT's histogram of gradients: 4x4 cells of 8 orientations from 16x16 samples in the keypoint's
// own frame. There the cells' weights of a sample are the same for every keypoint.
namespace kestrel::kernels::KESTREL_KERNELS {
namespace {

constexpr int kSide = 16;  // samples
constexpr int kBins = 8;

/// One vector or two: the orientations of a cell.
struct Cell {
  Floats part[kBins / kLanes];
};

inline void add(Cell& sum, const Cell& cell, float weight) {
  for (int p = 0; p < kBins / kLanes; ++p) sum.part[p] += cell.part[p] * weight;
}

/// Between the two numbers of each pair.
inline Floats between(Ints pairs, Floats share) {
  const Ints first = (pairs << 16) >> 16;
  return __builtin_convertvector(first, Floats) +
         share * __builtin_convertvector((pairs >> 16) - first, Floats);
}

/// The grid of samples, bilinear; outside the image its border goes on.
void resample(const DescriptorPatch& patch, float* samples) {
  const float last_u = float(patch.width - 1);
  const float last_v = float(patch.height - 1);
  for (int k = 0; k < kGridSize; k += kLanes) {
    const Floats across = floats(patch.grid->across + k);
    const Floats down = floats(patch.grid->down + k);
    Floats u = patch.u + across * patch.step_u - down * patch.step_v;
    Floats v = patch.v + across * patch.step_v + down * patch.step_u;
    u = larger(smaller(u, all(last_u)), Floats{});
    v = larger(smaller(v, all(last_v)), Floats{});
    // At the last column and row the pixel beyond counts nothing, but is read.
    const Ints column = smaller(__builtin_convertvector(u, Ints), all(patch.width - 2));
    const Ints row = smaller(__builtin_convertvector(v, Ints), all(patch.height - 2));
    const Floats right = u - __builtin_convertvector(column, Floats);
    const Floats below = v - __builtin_convertvector(row, Floats);
    const Ints index = row * patch.stride + column;
    const Floats top = between(pairs_at(patch.image, index), right);
    const Floats bottom = between(pairs_at(patch.image + patch.stride, index), right);
    store(samples + k, top + below * (bottom - top));
  }
}

/// Of each sample the two orientation bins it falls between, and its share of each.
struct Gradients {
  alignas(32) std::int32_t bin[256];
  alignas(32) float share[256];
  alignas(32) float next_share[256];
};

void gradients(const DescriptorGrid& grid, const float* samples, Gradients& out) {
  constexpr float kBinsPerRad = kBins / 6.283185307F;
  for (int k = 0; k < 256; k += kLanes) {
    const float* const at = samples + (k / kSide + 1) * kGridSide + k % kSide + 1;
    const Floats across = floats(at + 1) - floats(at - 1);
    const Floats up = floats(at - kGridSide) - floats(at + kGridSide);
    const Floats strength = root(across * across + up * up) * floats(grid.window + k);
    Floats angle = angle_of(up, across) * kBinsPerRad;
    angle += from_bits((angle < 0) & bits(all(float(kBins))));
    const Ints bin = __builtin_convertvector(angle, Ints);
    const Floats next = strength * (angle - __builtin_convertvector(bin, Floats));
    store(out.bin + k, bin & (kBins - 1));
    store(out.next_share + k, next);
    store(out.share + k, strength - next);
  }
}

/// Row b has all bits of lane b set; once more, so that row b + 1 follows row b.
struct BinMasks {
  alignas(32) std::int32_t lane[kBins + 1][kBins];
};
constexpr BinMasks bin_masks() {
  BinMasks masks{};
  for (int b = 0; b <= kBins; ++b) masks.lane[b][b % kBins] = -1;
  return masks;
}
constexpr BinMasks kBinMasks = bin_masks();

/// The grid spans five cells, half a cell around the 4x4: sample s lies at cell
/// (s - 7.5) 5/16 + 1.5 = (10 s - 27) / 32, of which cells[s] is the floor, from -1 on.
constexpr int first_cell(int sample) { return (10 * sample - 27 + 32) / 32 - 1; }
constexpr float next_cell_share(int sample) {
  return float(10 * sample - 27 - 32 * first_cell(sample)) / 32;
}

/// Adds the samples Column..15 of a row to the row's four cells, with one beyond at each end.
template <int Column>
inline void add_samples(const Gradients& samples, int row, Cell (&cells)[6]) {
  if constexpr (Column < kSide) {
    const int k = row * kSide + Column;
    const std::int32_t* const mask = kBinMasks.lane[samples.bin[k]];
    Cell cell;
    for (int p = 0; p < kBins / kLanes; ++p) {
      cell.part[p] = from_bits((load<Ints>(mask + p * kLanes) & bits(all(samples.share[k]))) |
                               (load<Ints>(mask + kBins + p * kLanes) &
                                bits(all(samples.next_share[k]))));
    }
    constexpr int kFirst = first_cell(Column) + 1;
    add(cells[kFirst], cell, 1 - next_cell_share(Column));
    add(cells[kFirst + 1], cell, next_cell_share(Column));
    add_samples<Column + 1>(samples, row, cells);
  }
}

/// 4x4 cells of 8 bins.
void histogram(const Gradients& samples, float* bins) {
  Cell cells[6][4] = {};  // with one row beyond at each end
  for (int row = 0; row < kSide; ++row) {
    Cell sums[6] = {};
    add_samples<0>(samples, row, sums);
    const int first = first_cell(row) + 1;
    const float share = next_cell_share(row);
    for (int c = 0; c < 4; ++c) {
      add(cells[first][c], sums[c + 1], 1 - share);
      add(cells[first + 1][c], sums[c + 1], share);
    }
  }
  for (int c = 0; c < 16; ++c)
    for (int p = 0; p < kBins / kLanes; ++p)
      store(bins + c * kBins + p * kLanes, cells[1 + c / 4][c % 4].part[p]);
}

inline float total(const Cell& cell) {
  alignas(32) float lanes[kBins];
  for (int p = 0; p < kBins / kLanes; ++p) store(lanes + p * kLanes, cell.part[p]);
  return ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) +
         ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
}

/// Lowe's limit of a bin to 0.2 of the norm, then the root of each bin's share of the whole.
void quantize(const float* histogram_bins, std::uint8_t* bins) {
  constexpr int kParts = kBins / kLanes;
  Cell squares{};
  for (int k = 0; k < 128; k += kLanes) {
    const Floats h = floats(histogram_bins + k);
    squares.part[k / kLanes % kParts] += h * h;
  }
  const Floats limit = 0.2F * root(all(total(squares)));
  Cell sums{};
  for (int k = 0; k < 128; k += kLanes)
    sums.part[k / kLanes % kParts] += smaller(floats(histogram_bins + k), limit);
  const Floats scale = 65536 / (all(total(sums)) + 1e-30F);
  for (int k = 0; k < 128; k += kLanes) {
    alignas(32) std::int32_t rooted[kLanes];
    const Floats share = smaller(floats(histogram_bins + k), limit) * scale;
    store(rooted, rounded(smaller(root(share), all(127.F))));
    for (int i = 0; i < kLanes; ++i) bins[k + i] = std::uint8_t(rooted[i]);
  }
}

void describe(const DescriptorPatch& patch) {
  alignas(32) float samples[kGridSize];
  Gradients oriented;
  alignas(32) float bins[128];
  resample(patch, samples);
  gradients(*patch.grid, samples, oriented);
  histogram(oriented, bins);
  quantize(bins, patch.bins);
}

}  // namespace
}  // namespace kestrel::kernels::KESTREL_KERNELS

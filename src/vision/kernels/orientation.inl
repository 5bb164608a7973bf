// Histogram of the gradients' orientations about a keypoint.
namespace kestrel::kernels::KESTREL_KERNELS {
namespace {

/// Differences a - b of neighbouring pixels, or of every second.
inline Floats differences(const std::int16_t* a, const std::int16_t* b, int step) {
  if (step == 1) return __builtin_convertvector(widened(a) - widened(b), Floats);
  const Ints pairs = Ints(shorts(a) - shorts(b));
  return __builtin_convertvector((pairs << 16) >> 16, Floats);
}

struct OrientedRow {
  alignas(32) std::int32_t bin[40];
  alignas(32) float weight[40];
};

/// Bins and weights of the samples left..left+count of a row.
inline void orient_row(const OrientationPatch& patch, const std::int16_t* row, float weight, int left,
                       int count, OrientedRow& out) {
  constexpr float kBinsPerRad = kOrientations / 6.283185307F;
  const int step = patch.step;
  for (int k = 0; k < count; k += kLanes) {
    const std::int16_t* const at = row + (left + k) * step;
    const Floats across = differences(at + 1, at - 1, step);
    const Floats down = differences(at + patch.stride, at - patch.stride, step);
    const Floats strength = root(across * across + down * down);
    const Ints bin = rounded(angle_of(down, across) * kBinsPerRad);
    store(out.bin + k, bin + ((bin < 0) & kOrientations));
    const Floats window = floats(patch.weight + kMaxOrientationRadius + left + k);
    store(out.weight + k, strength * (window * weight));
  }
}

inline int at_most(int a, int b) { return a < b ? a : b; }

void orientations(const OrientationPatch& patch) {
  // Four histograms in turn: an addition need not wait for the one before.
  float parts[4][kOrientations] = {};
  OrientedRow row;
  const int radius = patch.radius;
  int half = 0;  // of the disc's chord
  for (int y = -radius; y <= radius; ++y) {
    while (half < radius && (half + 1) * (half + 1) + y * y <= radius * radius) ++half;
    while (half * half + y * y > radius * radius) --half;
    if (y < -patch.above || y > patch.below) continue;
    const int left = -at_most(half, patch.left);
    const int count = at_most(half, patch.right) - left + 1;
    orient_row(patch, patch.centre + y * patch.step * patch.stride,
               patch.weight[kMaxOrientationRadius + y], left, count, row);
    for (int k = 0; k < count; ++k) parts[k & 3][row.bin[k]] += row.weight[k];
  }
  for (int b = 0; b < kOrientations; ++b)
    patch.histogram[b] = (parts[0][b] + parts[1][b]) + (parts[2][b] + parts[3][b]);
}

}  // namespace
}  // namespace kestrel::kernels::KESTREL_KERNELS

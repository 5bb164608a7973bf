// The body of kernels_avx2.cpp and kernels_baseline.cpp, which define KERNEL(name).
// No function of the standard library is used: an inline one compiled here for AVX2 could be the
// copy that the linker keeps for everybody.
#include "taps.inl"

namespace kestrel::sim_detail {
namespace {

constexpr int kPixels = 16;                   // of a run
constexpr std::ptrdiff_t kFloatsOfARun = 32;  // x and y

template <Floats (*Tap)(const Reading&, Floats, Floats)>
inline Floats mean_of_taps(const Reading& r, Floats s, Floats t) {
  if (r.across == 1 && r.down == 1) return Tap(r, s, t);
  Floats sum{};
  for (int j = 0; j < r.down; ++j) {
    const float y = float(j) - 0.5f * float(r.down - 1);
    for (int i = 0; i < r.across; ++i) {
      const float x = float(i) - 0.5f * float(r.across - 1);
      sum += Tap(r, s + (x * r.across_s + y * r.down_s), t + (x * r.across_t + y * r.down_t));
    }
  }
  return sum / float(r.across * r.down);
}

template <Floats (*Tap)(const Reading&, Floats, Floats)>
inline void add(Reading r, const float* rays, int rows, float* light) {
  const float* const m = r.place_from_ray;
  for (int row = 0; row < rows; ++row, rays += kFloatsOfARun, light += kPixels) {
    for (int k = 0; k < kPixels; k += kLanes) {
      const Floats x = load(rays + k);
      const Floats y = load(rays + kPixels + k);
      const Floats depth = 1 / larger(m[6] * x + m[7] * y + m[8], kNearlyAlong);
      const Floats s = (m[0] * x + m[1] * y + m[2]) * depth;
      const Floats t = (m[3] * x + m[4] * y + m[5]) * depth;
      const Floats sum = load(light + k) + mean_of_taps<Tap>(r, s, t);
      __builtin_memcpy(light + k, &sum, sizeof sum);
    }
  }
}

/// All bits of x and some of the high seed in each bit: the mixer of 32 bits named lowbias32 (C.
/// Wellons, "Prospecting for Hash Functions", 2018; public domain), the high seed in its middle.
inline Words scrambled(Words x, std::uint32_t high) {
  x = (x ^ (x >> 16)) * 0x7feb352du ^ high;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

/// By bits 4 to 15 of each lane.
inline Floats normal(const float* quantiles, Words bits) {
  const Ints at = Ints((bits >> 4) & (kQuantiles - 1u));
  return Floats{quantiles[at[0]], quantiles[at[1]], quantiles[at[2]], quantiles[at[3]],
                quantiles[at[4]], quantiles[at[5]], quantiles[at[6]], quantiles[at[7]]};
}

}  // namespace

void KERNEL(add_mean_light)(const Reading& r, const float* rays, int rows, float* light) {
  if (!(r.width_s > 0)) return add<bilinear>(r, rays, rows, light);
  if (r.width_t > 1) return add<smooth>(r, rays, rows, light);
  add<smooth_low>(r, rays, rows, light);
}

void KERNEL(sense)(const Sensor& sensor, const float* light, int u, int v, std::uint8_t* grey) {
  const Ints lane{0, 1, 2, 3, 4, 5, 6, 7};
  const float y = float(v) - sensor.centre_v;
  Words bits = Words(lane + u) + std::uint32_t(v) * kMostColumns;
  bits = scrambled(bits ^ sensor.seed_low, sensor.seed_high);
  for (int k = 0; k < kPixels; k += kLanes, bits >>= 16) {
    const Floats x = __builtin_convertvector(lane + (u + k), Floats) - sensor.centre_u;
    Floats value = load(light + k) * (sensor.gain - sensor.loss * (x * x + y * y));
    if (sensor.noise_grey > 0) value += sensor.noise_grey * normal(sensor.quantiles, bits);
    const Ints rounded_value = __builtin_convertvector(smaller(larger(value + 0.5f, 0), 255), Ints);
    const Bytes bytes = __builtin_convertvector(rounded_value, Bytes);
    __builtin_memcpy(grey + k, &bytes, sizeof bytes);
  }
}

}  // namespace kestrel::sim_detail

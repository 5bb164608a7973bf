// The body of kernels_avx2.cpp and kernels_baseline.cpp, which define KERNEL(name).
// No function of the standard library is used: an inline one compiled here for AVX2 could be the
// copy that the linker keeps for everybody.
#include "taps.inl"

namespace kestrel::sim_detail {
namespace {

constexpr int kPixels = 16;                   // of a run
constexpr std::ptrdiff_t kFloatsOfARun = 32;  // x and y

template <Floats (*Tap)(const Reading&, Floats, Floats)>
KESTREL_INLINE Floats mean_of_taps(const Reading& r, Floats s, Floats t) {
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

/// Sixteen numbers from 0 to 255.
inline void store_bytes(Ints a, Ints b, std::uint8_t* to) {
#ifdef __AVX2__
  const __m256i halves = _mm256_packs_epi32(__m256i(a), __m256i(b));
  const __m256i words = _mm256_permute4x64_epi64(halves, 0xd8);
  const __m128i bytes =
      _mm_packus_epi16(_mm256_castsi256_si128(words), _mm256_extracti128_si256(words, 1));
#else
  __m128i parts[4];
  __builtin_memcpy(parts, &a, sizeof a);
  __builtin_memcpy(parts + 2, &b, sizeof b);
  const __m128i bytes =
      _mm_packus_epi16(_mm_packs_epi32(parts[0], parts[1]), _mm_packs_epi32(parts[2], parts[3]));
#endif
  __builtin_memcpy(to, &bytes, sizeof bytes);
}

}  // namespace

void KERNEL(add_mean_light)(const Reading& r, const float* rays, int rows, float* light) {
  if (!(r.width_s > 0)) return add<bilinear>(r, rays, rows, light);
  add<smooth>(r, rays, rows, light);
}

void KERNEL(sense)(const Sensor& sensor, const float* light, const Patch& patch) {
  const Sensor s = sensor;
  const Ints lane{0, 1, 2, 3, 4, 5, 6, 7};
  const Floats x_left = __builtin_convertvector(lane + patch.u, Floats) - s.centre_u;
  const Floats x_right = x_left + kLanes;
  const Floats left = s.gain - s.loss * (x_left * x_left);
  const Floats right = s.gain - s.loss * (x_right * x_right);
  std::uint8_t* grey = patch.grey;
  for (int row = 0; row < patch.rows; ++row, grey += patch.stride, light += kPixels) {
    const int v = patch.v + row;
    const float y = float(v) - s.centre_v;
    const float loss = s.loss * (y * y);
    Floats a = load(light) * (left - loss);
    Floats b = load(light + kLanes) * (right - loss);
    if (s.noise_grey > 0) {
      const Words pixel = Words(lane + patch.u) + std::uint32_t(v) * kMostColumns;
      const Words bits = scrambled(pixel ^ s.seed_low, s.seed_high);
      a += s.noise_grey * normal(s.quantiles, bits);
      b += s.noise_grey * normal(s.quantiles, bits >> 16);
    }
    store_bytes(rounded(smaller(larger(a, 0), 255)), rounded(smaller(larger(b, 0), 255)), grey);
  }
}

}  // namespace kestrel::sim_detail

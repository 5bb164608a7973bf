// Vectors of the native width. What is done lane by lane does not depend on it.
namespace kestrel::kernels::KESTREL_KERNELS {
namespace {

#ifdef __AVX2__
constexpr int kBytes = 32;
#else
constexpr int kBytes = 16;
#endif
constexpr int kLanes = kBytes / 4;
constexpr int kShortLanes = kBytes / 2;

using Floats = float __attribute__((vector_size(kBytes)));
using Ints = std::int32_t __attribute__((vector_size(kBytes)));
using Shorts = std::int16_t __attribute__((vector_size(kBytes)));
using Bytes = std::uint8_t __attribute__((vector_size(kBytes)));

template <typename Vector, typename Element>
inline Vector load(const Element* from) {
  Vector v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

template <typename Vector, typename Element>
inline void store(Element* to, const Vector& v) {
  __builtin_memcpy(to, &v, sizeof v);
}

inline Floats floats(const float* from) { return load<Floats>(from); }
inline Shorts shorts(const std::int16_t* from) { return load<Shorts>(from); }
inline Floats all(float x) { return Floats{} + x; }
inline Ints all(std::int32_t x) { return Ints{} + x; }
inline Shorts all(std::int16_t x) { return Shorts{} + x; }

/// 0, 1, 2, ...
inline Ints counting() {
  Ints v{};
  for (int i = 0; i < kLanes; ++i) v[i] = i;
  return v;
}

inline Ints bits(Floats v) { return load<Ints>(&v); }
inline Floats from_bits(Ints v) { return load<Floats>(&v); }
inline Floats absolute(Floats v) { return from_bits(bits(v) & 0x7fffffff); }
/// a where mask, else b.
inline Floats choose(Ints mask, Floats a, Floats b) {
  return from_bits((mask & bits(a)) | (~mask & bits(b)));
}
inline Ints choose(Ints mask, Ints a, Ints b) { return (mask & a) | (~mask & b); }
inline Ints smaller(Ints a, Ints b) { return choose(a < b, a, b); }

#ifdef __AVX2__
inline Floats root(Floats v) { return Floats(_mm256_sqrt_ps(__m256(v))); }
inline Floats larger(Floats a, Floats b) { return Floats(_mm256_max_ps(__m256(a), __m256(b))); }
inline Floats smaller(Floats a, Floats b) { return Floats(_mm256_min_ps(__m256(a), __m256(b))); }
inline Ints rounded(Floats v) { return Ints(_mm256_cvtps_epi32(__m256(v))); }
inline Shorts larger(Shorts a, Shorts b) {
  return Shorts(_mm256_max_epi16(__m256i(a), __m256i(b)));
}
inline Shorts smaller(Shorts a, Shorts b) {
  return Shorts(_mm256_min_epi16(__m256i(a), __m256i(b)));
}
/// Two vectors of numbers to one of 16 bits, in order.
inline Shorts packed(Ints a, Ints b) {
  const __m256i halves = _mm256_packs_epi32(__m256i(a), __m256i(b));
  return Shorts(_mm256_permute4x64_epi64(halves, 0xd8));
}
/// Two bits for each lane.
inline unsigned mask_of(Shorts v) { return unsigned(_mm256_movemask_epi8(__m256i(v))); }
/// The numbers at `from`, each in 32 bits.
inline Ints widened(const std::int16_t* from) {
  return Ints(_mm256_cvtepi16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))));
}
/// Of each index the pair of numbers that starts there, the first in the low half.
inline Ints pairs_at(const std::int16_t* from, Ints index) {
  return Ints(_mm256_i32gather_epi32(reinterpret_cast<const int*>(from), __m256i(index), 2));
}
#else
inline Floats root(Floats v) { return Floats(_mm_sqrt_ps(__m128(v))); }
inline Floats larger(Floats a, Floats b) { return Floats(_mm_max_ps(__m128(a), __m128(b))); }
inline Floats smaller(Floats a, Floats b) { return Floats(_mm_min_ps(__m128(a), __m128(b))); }
inline Ints rounded(Floats v) { return Ints(_mm_cvtps_epi32(__m128(v))); }
inline Shorts larger(Shorts a, Shorts b) { return Shorts(_mm_max_epi16(__m128i(a), __m128i(b))); }
inline Shorts smaller(Shorts a, Shorts b) { return Shorts(_mm_min_epi16(__m128i(a), __m128i(b))); }
inline Shorts packed(Ints a, Ints b) { return Shorts(_mm_packs_epi32(__m128i(a), __m128i(b))); }
inline unsigned mask_of(Shorts v) { return unsigned(_mm_movemask_epi8(__m128i(v))); }
inline Ints widened(const std::int16_t* from) {
  const __m128i low = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from));
  return Ints(_mm_srai_epi32(_mm_unpacklo_epi16(low, low), 16));
}
inline Ints pairs_at(const std::int16_t* from, Ints index) {
  Ints pairs{};
  for (int i = 0; i < kLanes; ++i) {
    std::int32_t pair;
    __builtin_memcpy(&pair, from + index[i], 4);
    pairs[i] = pair;
  }
  return pairs;
}
#endif

/// Angle from (1, 0) to (x, y), rad in [-pi, pi]; 0 for (0, 0). The polynomial is the minimax fit
/// (Remez) of arctan on [0, 1] with five odd terms: within 1.2e-5 rad.
inline Floats angle_of(Floats y, Floats x) {
  const Floats ax = absolute(x);
  const Floats ay = absolute(y);
  const Floats t = smaller(ax, ay) / (larger(ax, ay) + 1e-30F);
  const Floats s = t * t;
  Floats a = all(0.020845115F);
  a = a * s - 0.085156353F;
  a = a * s + 0.180159296F;
  a = a * s - 0.330304786F;
  a = a * s + 0.999866330F;
  a = a * t;
  a = choose(ay > ax, 1.570796327F - a, a);
  a = choose(x < 0, 3.141592654F - a, a);
  return choose(y < 0, -a, a);
}

}  // namespace
}  // namespace kestrel::kernels::KESTREL_KERNELS

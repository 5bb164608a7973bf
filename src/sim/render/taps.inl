// Vectors, and places of a texture read eight at a time. Part of kernels.inl.

namespace kestrel::sim_detail {
namespace {

using Floats = float __attribute__((vector_size(32)));
using Ints = std::int32_t __attribute__((vector_size(32)));
using Words = std::uint32_t __attribute__((vector_size(32)));

constexpr int kLanes = 8;

/// In a loop over pixels, so that what is the same for all of them is worked out once.
#define KESTREL_INLINE [[gnu::always_inline]] inline

inline Floats load(const float* at) {
  Floats v;
  __builtin_memcpy(&v, at, sizeof v);
  return v;
}

/// The first where it is larger, else the second: not a number gives the second.
inline Floats larger(Floats a, float b) { return a > b ? a : Floats{} + b; }
inline Floats smaller(Floats a, float b) { return a < b ? a : Floats{} + b; }

inline std::uint32_t word(const std::uint8_t* at) {
  std::uint32_t w;
  __builtin_memcpy(&w, at, sizeof w);
  return w;
}

inline Words gather(const std::uint8_t* p, Ints at) {
  return Words{word(p + at[0]), word(p + at[1]), word(p + at[2]), word(p + at[3]),
               word(p + at[4]), word(p + at[5]), word(p + at[6]), word(p + at[7])};
}

template <int Byte>
inline Floats byte(Words v) {
  return __builtin_convertvector(Ints((v >> (8 * Byte)) & 255u), Floats);
}

/// Places on the texture: the value up and to the left of each, and how far on it lies.
struct Places {
  Ints offset;
  Floats a;
  Floats b;
};

KESTREL_INLINE Places places(const Reading& r, Floats s, Floats t, std::int32_t texel) {
  s = smaller(larger(s, 0), r.last_s);
  t = smaller(larger(t, 0), r.last_t);
  const Ints column = __builtin_convertvector(s, Ints);  // not negative: truncation is floor
  const Ints row = __builtin_convertvector(t, Ints);
  return {row * r.stride + column * texel, s - __builtin_convertvector(column, Floats),
          t - __builtin_convertvector(row, Floats)};
}

KESTREL_INLINE Floats bilinear(const Reading& r, Floats s, Floats t) {
  const Places at = places(r, s, t, 1);
  const Words upper = gather(r.texels, at.offset);
  const Words lower = gather(r.texels + r.stride, at.offset);
  const Floats u0 = byte<0>(upper);
  const Floats l0 = byte<0>(lower);
  const Floats top = u0 + at.a * (byte<1>(upper) - u0);
  const Floats bottom = l0 + at.a * (byte<1>(lower) - l0);
  return top + at.b * (bottom - top);
}

/// Four texels below each other, four of these side by side around each place.
struct Columns {
  Words column[4];
};

#ifdef __AVX2__
KESTREL_INLINE Columns columns(const std::uint8_t* p, Ints at) {
  const auto four = [&](int i) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p + at[i]));
  };
  const auto both = [&](int i) { return _mm256_set_m128i(four(i + 4), four(i)); };
  const __m256i low01 = _mm256_unpacklo_epi32(both(0), both(1));
  const __m256i high01 = _mm256_unpackhi_epi32(both(0), both(1));
  const __m256i low23 = _mm256_unpacklo_epi32(both(2), both(3));
  const __m256i high23 = _mm256_unpackhi_epi32(both(2), both(3));
  return {{Words(_mm256_unpacklo_epi64(low01, low23)), Words(_mm256_unpackhi_epi64(low01, low23)),
           Words(_mm256_unpacklo_epi64(high01, high23)),
           Words(_mm256_unpackhi_epi64(high01, high23))}};
}
#else
KESTREL_INLINE Columns columns(const std::uint8_t* p, Ints at) {
  return {{gather(p, at), gather(p + 4, at), gather(p + 8, at), gather(p + 12, at)}};
}
#endif

inline Floats squared(Floats v) { return v * v; }

/// What four values in a row weigh in the mean, over the interval [a - h/2, a + h/2] with a in [0,
/// 1) from the second of them, of the straight lines between them. The interval reaches beyond the
/// second by h/2 - a and beyond the third by a + h/2 - 1: each of these ends adds its square / 2h
/// to the outermost value. A line keeps its mean, and that gives the inner two.
struct Weights {
  Floats first;
  Floats second;
  Floats third;
  Floats fourth;
};

KESTREL_INLINE Weights weights(Floats a, float width) {
  const float half = width / 2;
  const float scale = 1 / (2 * width);
  const Floats before = squared(larger(half - a, 0)) * scale;
  const Floats after = squared(larger(a - (1 - half), 0)) * scale;
  return {before, (1 - a) - 2 * before + after, a + before - 2 * after, after};
}

/// The same in 1/kOne, pairs of them in the halves of a lane: first and third, second and fourth.
struct Pairs {
  Ints first_third;
  Ints second_fourth;
};
constexpr float kOne = 16384;

inline Ints rounded(Floats v) { return __builtin_convertvector(v + 0.5f, Ints); }

KESTREL_INLINE Pairs pairs(const Weights& w) {
  const Ints first = rounded(w.first * kOne);
  const Ints third = rounded(w.third * kOne);
  const Ints fourth = rounded(w.fourth * kOne);
  const Ints second = std::int32_t(kOne) - first - third - fourth;
  return {first | (third << 16), (second & 0xffff) | (fourth << 16)};
}

/// Products of the halves of the lanes, 16 bits with sign, added.
inline Ints pair_products(Ints x, Ints y) {
#ifdef __AVX2__
  return Ints(_mm256_madd_epi16(__m256i(x), __m256i(y)));
#else
  __m128i a[2];
  __m128i b[2];
  __builtin_memcpy(a, &x, sizeof x);
  __builtin_memcpy(b, &y, sizeof y);
  const __m128i sums[2] = {_mm_madd_epi16(a[0], b[0]), _mm_madd_epi16(a[1], b[1])};
  Ints result;
  __builtin_memcpy(&result, sums, sizeof result);
  return result;
#endif
}

/// Four bytes in each lane, weighted.
KESTREL_INLINE Floats weighted(const Pairs& w, Words v) {
  return __builtin_convertvector(pair_products(Ints(v & 0xff00ffu), w.first_third) +
                                     pair_products(Ints((v >> 8) & 0xff00ffu), w.second_fourth),
                                 Floats);
}

/// The mean over a rectangle of what bilinear() would be at a place.
KESTREL_INLINE Floats smooth(const Reading& r, Floats s, Floats t) {
  constexpr std::int32_t kTexel = 4;  // bytes: of a column
  const Places at = places(r, s, t, kTexel);
  const Columns texels = columns(r.texels, at.offset);
  const Pairs down = pairs(weights(at.b, r.width_t));
  const Weights across = weights(at.a, r.width_s);
  const Floats sum = (across.first * weighted(down, texels.column[0]) +
                      across.second * weighted(down, texels.column[1])) +
                     (across.third * weighted(down, texels.column[2]) +
                      across.fourth * weighted(down, texels.column[3]));
  return sum * (1 / kOne);
}

}  // namespace
}  // namespace kestrel::sim_detail

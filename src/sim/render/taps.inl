// Vectors, and places of a texture read eight at a time. Part of kernels.inl.

namespace kestrel::sim_detail {
namespace {

using Floats = float __attribute__((vector_size(32)));
using Ints = std::int32_t __attribute__((vector_size(32)));
using Words = std::uint32_t __attribute__((vector_size(32)));
using Bytes = std::uint8_t __attribute__((vector_size(8)));

constexpr int kLanes = 8;
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

inline Places places(const Reading& r, Floats s, Floats t) {
  s = smaller(larger(s, 0), r.last_s);
  t = smaller(larger(t, 0), r.last_t);
  const Ints column = __builtin_convertvector(s, Ints);  // not negative: truncation is floor
  const Ints row = __builtin_convertvector(t, Ints);
  return {row * r.stride + column, s - __builtin_convertvector(column, Floats),
          t - __builtin_convertvector(row, Floats)};
}

inline Floats bilinear(const Reading& r, Floats s, Floats t) {
  const Places at = places(r, s, t);
  const Words upper = gather(r.texels, at.offset);
  const Words lower = gather(r.texels + r.stride, at.offset);
  const Floats u0 = byte<0>(upper);
  const Floats l0 = byte<0>(lower);
  const Floats top = u0 + at.a * (byte<1>(upper) - u0);
  const Floats bottom = l0 + at.a * (byte<1>(lower) - l0);
  return top + at.b * (bottom - top);
}

inline Floats squared(Floats v) { return v * v; }

/// What four values in a row weigh in the mean, over the interval [a - h/2, a + h/2] with a in [0,
/// 1) from the second of them, of the straight lines between them. The interval reaches beyond the
/// second by h/2 - a and beyond the third by a + h/2 - 1: each of these ends adds its square / 2h
/// to the outermost value. A line keeps its mean, and that gives the inner two. In 1/kOne, pairs of
/// them in the halves of a lane: first and third, second and fourth.
struct Across {
  Ints first_third;
  Ints second_fourth;
};
constexpr float kOne = 16384;

inline Ints rounded(Floats v) { return __builtin_convertvector(v + 0.5f, Ints); }

inline Across weights_across(Floats a, float width) {
  const float half = width / 2;
  const float scale = kOne / (2 * width);
  const Floats before = squared(larger(half - a, 0)) * scale;
  const Floats after = squared(larger(a - (1 - half), 0)) * scale;
  const Ints first = rounded(before);
  const Ints third = rounded(kOne * a + before - 2 * after);
  const Ints fourth = rounded(after);
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
inline Floats weighted(const Across& w, Words v) {
  return __builtin_convertvector(pair_products(Ints(v & 0xff00ffu), w.first_third) +
                                     pair_products(Ints((v >> 8) & 0xff00ffu), w.second_fourth),
                                 Floats);
}

/// The mean over a rectangle of what bilinear() is at a place.
inline Floats smooth(const Reading& r, Floats s, Floats t) {
  const Places at = places(r, s, t);
  const Across across = weights_across(at.a, r.width_s);
  const float half = r.width_t / 2;
  const float scale = 1 / (2 * r.width_t);
  const Floats before = squared(larger(half - at.b, 0)) * scale;  // as across
  const Floats after = squared(larger(at.b - (1 - half), 0)) * scale;
  const Floats down[4] = {before, (1 - at.b) - 2 * before + after, at.b + before - 2 * after,
                          after};
  Floats sum{};
  const std::uint8_t* row = r.texels;
  for (int i = 0; i < 4; ++i, row += r.stride) {
    sum += down[i] * weighted(across, gather(row, at.offset));
  }
  return sum * (1 / kOne);
}

/// The same of a rectangle at most one texel high: the three rows nearest to its middle hold it. An
/// end of the interval [b - h/2, b + h/2], b from the middle row, gives to the row on its side the
/// integral of the line up from the middle one.
inline Floats smooth_low(const Reading& r, Floats s, Floats t) {
  s = smaller(larger(s, 0), r.last_s);
  t = smaller(larger(t, 0), r.last_t);
  const Ints column = __builtin_convertvector(s, Ints);
  const Ints row = rounded(t);
  const Floats a = s - __builtin_convertvector(column, Floats);
  const Floats b = t - __builtin_convertvector(row, Floats);
  const Ints offset = row * r.stride + column;
  const Across across = weights_across(a, r.width_s);
  const float half = r.width_t / 2;
  const float scale = 1 / (2 * r.width_t);
  const Floats above = (squared(larger(half - b, 0)) - squared(larger(-half - b, 0))) * scale;
  const Floats below = (squared(larger(half + b, 0)) - squared(larger(b - half, 0))) * scale;
  const std::uint8_t* const middle = r.texels + r.stride;
  const Floats sum = above * weighted(across, gather(r.texels, offset)) +
                     (1 - above - below) * weighted(across, gather(middle, offset)) +
                     below * weighted(across, gather(middle + r.stride, offset));
  return sum * (1 / kOne);
}

}  // namespace
}  // namespace kestrel::sim_detail

// Exact distances of 7-bit descriptors.
//
// Eight descriptors of the model lie interleaved, four bins at a time: a lane of 32 bits belongs to
// one of them. Bins are at most 127, so the sum of two products fits a signed 16-bit number
// (pmaddubsw). The sums of each half of a lane go on in 16 bits unsigned, held at 65535: no pair of
// RootSIFT descriptors gets there (the product of the norms is about 65536, and half of the bins
// would have to hold all of it).
namespace kestrel::kernels::KESTREL_KERNELS {
namespace {

constexpr int kSteps = 32;
constexpr int kModelParts = kModelBlock / kLanes;

#ifdef __AVX2__
inline Shorts pair_products(Bytes model, std::int32_t query) {
  return Shorts(_mm256_maddubs_epi16(__m256i(model), _mm256_set1_epi32(query)));
}
inline Shorts sum_up(Shorts a, Shorts b) {
  return Shorts(_mm256_adds_epu16(__m256i(a), __m256i(b)));
}
#else
inline Shorts pair_products(Bytes model, std::int32_t query) {
  const Shorts q = Shorts(_mm_set1_epi32(query));
  const Shorts m = Shorts(model);
  return (m & 0xff) * (q & 0xff) + ((m >> 8) & 0xff) * ((q >> 8) & 0xff);
}
inline Shorts sum_up(Shorts a, Shorts b) { return Shorts(_mm_adds_epu16(__m128i(a), __m128i(b))); }
#endif

/// Dot products of kQueries descriptors with the kLanes of the model at `model`.
inline void dots(const std::uint8_t* model, const std::uint8_t* const* queries,
                 Ints (&dot)[kQueries]) {
  Shorts sums[kQueries] = {};
  for (int step = 0; step < kSteps; ++step) {
    const Bytes bins = load<Bytes>(model + step * kModelBlock * 4);
    for (int q = 0; q < kQueries; ++q) {
      std::int32_t four;
      __builtin_memcpy(&four, queries[q] + 4 * step, 4);
      sums[q] = sum_up(sums[q], pair_products(bins, four));
    }
  }
  for (int q = 0; q < kQueries; ++q) {
    const Ints both = Ints(sums[q]);
    dot[q] = (both & 0xffff) + ((both >> 16) & 0xffff);
  }
}

void compare(const DistanceBlock& block) {
  for (int b = 0; b < block.blocks * kModelParts; ++b) {
    const int first = b * kLanes;
    const std::uint8_t* const model =
        block.model + std::int64_t(b / kModelParts) * kSteps * kModelBlock * 4 +
        b % kModelParts * kBytes;
    Ints dot[kQueries];
    dots(model, block.queries, dot);
    const Ints norms = load<Ints>(block.model_norms + first);
    Ints nearest_query = load<Ints>(block.nearest_query + first);
    for (int q = 0; q < block.count; ++q) {
      const Ints distance = norms + block.query_norms[q] - 2 * dot[q];
      store(block.distances[q] + first, distance);
      const Ints key = (distance << kIndexBits) | (block.first_query + q);
      nearest_query = smaller(key, nearest_query);
    }
    store(block.nearest_query + first, nearest_query);
  }
}

std::int32_t nearest(const std::int32_t* distances, int blocks) {
  Ints index = counting();
  Ints best = all(std::int32_t(0x7fffffff));
  for (int k = 0; k < blocks * kModelBlock; k += kLanes) {
    best = smaller((load<Ints>(distances + k) << kIndexBits) | index, best);
    index += kLanes;
  }
  std::int32_t smallest = best[0];
  for (int i = 1; i < kLanes; ++i) smallest = best[i] < smallest ? best[i] : smallest;
  return smallest;
}

}  // namespace
}  // namespace kestrel::kernels::KESTREL_KERNELS

// The body of block_kernels_avx2.cpp and block_kernels_baseline.cpp, which define KERNEL(name).
// No function of the standard library is used: an inline one compiled here for AVX2 could be the
// copy that the linker keeps for everybody.

namespace kestrel::kernel {
namespace {

using Floats = float __attribute__((vector_size(32)));
using Ints = std::int32_t __attribute__((vector_size(32)));
using Words = std::uint32_t __attribute__((vector_size(32)));

constexpr int kLanes = 8;
static_assert(kBlockSide == kLanes, "one row of a block is one vector");

inline Floats load(const float* at) {
  Floats v;
  __builtin_memcpy(&v, at, sizeof v);
  return v;
}

inline float sum(Floats v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

/// All ones in each lane where the condition holds, as for comparisons of vectors.
inline bool all(Ints condition) {
  std::int64_t four[4];
  __builtin_memcpy(four, &condition, sizeof four);
  return (four[0] & four[1] & four[2] & four[3]) == -1;
}

/// Four bytes at an address: the pixel, its right neighbour and two that are not used.
inline std::uint32_t word(const std::uint8_t* at) {
  std::uint32_t w;
  __builtin_memcpy(&w, at, sizeof w);
  return w;
}

inline Words gather(const std::uint8_t* p, Ints at) {
  return Words{word(p + at[0]), word(p + at[1]), word(p + at[2]), word(p + at[3]),
               word(p + at[4]), word(p + at[5]), word(p + at[6]), word(p + at[7])};
}

inline Floats low_byte(Words v) { return __builtin_convertvector(Ints(v & 255u), Floats); }
inline Floats next_byte(Words v) { return __builtin_convertvector(Ints((v >> 8) & 255u), Floats); }

/// Bilinear samples at eight places, which lie in the image.
inline Floats sample(const Image& image, Floats u, Floats v) {
  const Ints column = __builtin_convertvector(u, Ints);  // u, v >= 0: truncation is floor
  const Ints row = __builtin_convertvector(v, Ints);
  const Floats a = u - __builtin_convertvector(column, Floats);
  const Floats b = v - __builtin_convertvector(row, Floats);
  const Ints offset = row * std::int32_t(image.stride) + column;
  const Words upper = gather(image.pixels, offset);
  const Words lower = gather(image.pixels + image.stride, offset);
  const Floats u0 = low_byte(upper);
  const Floats l0 = low_byte(lower);
  const Floats top = u0 + a * (next_byte(upper) - u0);
  const Floats bottom = l0 + a * (next_byte(lower) - l0);
  return top + b * (bottom - top);
}

/// True when the block's four corners, and with them all of it, lie in the image.
inline bool is_inside(const Image& image, const float* H, const Block& block) {
  constexpr float kFar = kBlockSide - 1;
  const Floats x = block.x + Floats{0, kFar, 0, kFar, 0, kFar, 0, kFar};
  const Floats y = block.y + Floats{0, 0, kFar, kFar, 0, 0, kFar, kFar};
  const Floats w = H[6] * x + H[7] * y + H[8];
  const Floats u = H[0] * x + H[1] * y + H[2];
  const Floats v = H[3] * x + H[4] * y + H[5];
  return all((w > 0.0f) & (u >= image.left * w) & (u <= image.right * w) & (v >= image.top * w) &
             (v <= image.bottom * w));
}

/// The samples of a block, row by row; false when some of it lies outside.
inline bool sample_block(const Image& image, const float* H, const Block& block, Floats* rows) {
  if (!is_inside(image, H, block)) return false;
  const Floats x = block.x + Floats{0, 1, 2, 3, 4, 5, 6, 7};
  const Floats wx = H[6] * x + H[8];
  const Floats ux = H[0] * x + H[2];
  const Floats vx = H[3] * x + H[5];
  for (int r = 0; r < kBlockSide; ++r) {
    const float y = block.y + float(r);
    const Floats one = 1.0f / (wx + H[7] * y);
    rows[r] = sample(image, (ux + H[1] * y) * one, (vx + H[4] * y) * one);
  }
  return true;
}

/// The three sums that tell how alike block and image are.
inline void add_likeness(const Block& block, const Floats* rows, BlockSums& sums) {
  Floats image{};
  Floats squared{};
  Floats product{};
  for (int r = 0; r < kBlockSide; ++r) {
    image += rows[r];
    squared += rows[r] * rows[r];
    product += rows[r] * load(block.texture + r * kLanes);
  }
  sums.image = sum(image);
  sums.image_squared = sum(squared);
  sums.texture_image = sum(product);
  sums.is_visible = 1;
}

}  // namespace

void KERNEL(sample_blocks)(const Image& image, const float* H, const Block* blocks, int count,
                           BlockSums* sums) {
  for (int i = 0; i < count; ++i) {
    sums[i] = BlockSums{};
    Floats rows[kBlockSide];
    if (!sample_block(image, H, blocks[i], rows)) continue;
    add_likeness(blocks[i], rows, sums[i]);
    for (int p = 0; p < kParameters; ++p) {
      const float* derivative = blocks[i].derivatives + p * kBlockPixels;
      Floats product = rows[0] * load(derivative);
      for (int r = 1; r < kBlockSide; ++r) product += rows[r] * load(derivative + r * kLanes);
      sums[i].derivatives[p] = sum(product);
    }
  }
}

void KERNEL(score_blocks)(const Image& image, const float* H, const Block* blocks, int count,
                          BlockSums* sums) {
  for (int i = 0; i < count; ++i) {
    sums[i] = BlockSums{};
    Floats rows[kBlockSide];
    if (sample_block(image, H, blocks[i], rows)) add_likeness(blocks[i], rows, sums[i]);
  }
}

void KERNEL(halve_row)(const std::uint8_t* upper, const std::uint8_t* lower, int count,
                       std::uint8_t* out) {
  for (int x = 0; x < count; ++x) {
    out[x] = std::uint8_t(
        (upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1] + 2) >> 2);
  }
}

}  // namespace kestrel::kernel

#pragma once

#include <cstddef>
#include <cstdint>

/// The inner loops of pyramid and alignment. Each is compiled twice from block_kernels.inl: for
/// AVX2 and for what every x86-64 has. Neither contracts a product and a sum into one rounding, so
/// both give the same bits.
namespace kestrel::kernel {

/// Pixels of a block: 8 rows of 8.
inline constexpr int kBlockSide = 8;
inline constexpr int kBlockPixels = 64;
/// Parameters of a homography near the identity.
inline constexpr int kParameters = 8;

/// An image to be sampled, 8-bit grey: pixel (0, 0) and the part that is there.
struct Image {
  const std::uint8_t* pixels;
  std::ptrdiff_t stride;
  float left, top;      // smallest coordinates that may be sampled
  float right, bottom;  // largest coordinates that may be sampled
};

/// What is known of a block of the template: its first pixel, its pixels less their mean, and the
/// derivatives of its pixels by the parameters, one after another.
struct Block {
  float x, y;
  const float* texture;      // kBlockPixels
  const float* derivatives;  // kParameters * kBlockPixels
};

/// Sums over the pixels of one block as the image shows it.
struct BlockSums {
  float image;                     // i
  float image_squared;             // i^2
  float texture_image;             // texture * i
  float derivatives[kParameters];  // derivative * i
  float is_visible;                // 1 when all of the block lies in the image, else 0
};

/// Bilinear samples of the image at H (x, y, 1), H row by row, for each pixel (x, y) of each block.
using SampleBlocks = void (*)(const Image& image, const float* H, const Block* blocks, int count,
                              BlockSums* sums);

/// out[x] = mean, rounded, of the four pixels at 2x and 2x + 1 of two rows.
using HalveRow = void (*)(const std::uint8_t* upper, const std::uint8_t* lower, int count,
                          std::uint8_t* out);

void sample_blocks_avx2(const Image&, const float*, const Block*, int, BlockSums*);
void sample_blocks_baseline(const Image&, const float*, const Block*, int, BlockSums*);
void score_blocks_avx2(const Image&, const float*, const Block*, int, BlockSums*);
void score_blocks_baseline(const Image&, const float*, const Block*, int, BlockSums*);
void halve_row_avx2(const std::uint8_t*, const std::uint8_t*, int, std::uint8_t*);
void halve_row_baseline(const std::uint8_t*, const std::uint8_t*, int, std::uint8_t*);

}  // namespace kestrel::kernel

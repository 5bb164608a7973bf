#pragma once

#include <cstdint>

#include "kestrel/vision/simd.hpp"

/// The inner loops of the vision layer. They are written once (*.inl) and compiled twice, with and
/// without AVX2; they use raw pointers and no inline function of the standard library, whose AVX2
/// copy the linker could otherwise hand to code that runs anywhere. Rows may be read and written up
/// to the next multiple of kRowBlock.
namespace kestrel::kernels {

constexpr int kRowBlock = 16;      // px
constexpr int kMaxRadius = 10;     // taps on each side of a blur's centre
constexpr int kMaxStep = 3;        // px between taps along a row
constexpr int kRowMargin = 32;     // px a blur may read beyond either end of a row
constexpr int kMaxDogs = 8;        // differences of Gaussians of an octave
constexpr float kDogScale = 64;    // of differences of Gaussians in 16 bits, 1/grey level
constexpr int kOrientations = 36;  // bins of the histogram of orientations
constexpr int kGridSide = 18;   // samples of a descriptor's grid, with one around for differences
constexpr int kGridSize = 328;  // kGridSide^2, to a multiple of 8
constexpr int kMaxOrientationRadius = 15;  // samples
constexpr int kIndexBits = 13;             // of a keypoint in the key of a match
constexpr int kQueries = 4;                // descriptors compared at once
constexpr int kModelBlock = 8;             // descriptors interleaved

/// One row of a separable blur: first down the columns of 2 radius + 1 rows, then along the row
/// with taps that stand step px apart; mirrored at the row's ends (without repeating them).
struct BlurRow {
  const float* const* rows;  // 2 radius + 1
  const float* taps;         // centre and one side: radius + 1
  int radius;
  int step;
  float* scratch;  // kRowMargin + width + kRowMargin, rounded up
  float* out;
  int width;
};

/// Search of one row for extrema of the differences of Gaussians among their 26 neighbours.
struct ExtremaRow {
  const std::int16_t* const* dogs;  // dogs x 3 rows: above, at, below; in units of 1/kDogScale
  int count;                        // dogs: layers + 2
  int begin;                        // columns searched: [begin, end)
  int end;
  int threshold;          // in units of 1/kDogScale, exceeded by |extrema|
  std::int16_t* scratch;  // (4 count) rows of `stride`
  int stride;
  std::int32_t* found;  // layer << 16 | column; as many as there are columns times layers
};

/// Gradients about a pixel: (2 radius + 1)^2 samples `step` px apart within the disc.
struct OrientationPatch {
  const float* centre;
  int stride;
  int radius;  // samples
  int step;    // px: 1 or 2
  int left;    // samples there are on each side of the centre, neighbours included
  int right;
  int above;
  int below;
  const float* weight;  // by place along a side: 2 kMaxOrientationRadius + 1, rounded up
  float* histogram;     // kOrientations: by angle from u to v
};

/// What of a descriptor is the same for all keypoints.
struct DescriptorGrid {
  alignas(32) float across[kGridSize];  // of sample, in samples from the keypoint
  alignas(32) float down[kGridSize];
  alignas(32) float window[256];  // weight of the inner 16x16
};

/// A descriptor's samples in an image.
struct DescriptorPatch {
  const DescriptorGrid* grid;
  const float* image;
  int stride;
  int width;
  int height;
  float u;  // px
  float v;
  float step_u;  // from one sample to the next across, px
  float step_v;
  std::uint8_t* bins;  // 128
};

/// Distances of kQueries descriptors to all of a model.
struct DistanceBlock {
  const std::uint8_t* model;           // blocks x 32 steps x 8 descriptors x 4 bins
  const std::int32_t* model_norms;     // squared
  int blocks;                          // of kModelBlock descriptors
  const std::uint8_t* const* queries;  // kQueries x 128 bins
  const std::int32_t* query_norms;
  std::int32_t* const* distances;  // kQueries rows of 8 blocks: squared distances
  std::int32_t* nearest_query;     // per model descriptor: smallest (distance << bits | query) yet
  int first_query;                 // index of queries[0]
  int count;                       // queries that are there: 1 to kQueries
};

/// The same functions for one instruction set.
struct Table {
  /// 8-bit pixels to floats.
  void (*widen)(const std::uint8_t* in, float* out, int count);
  void (*blur_row)(const BlurRow& row);
  /// dogs[i] = (levels[i + 1] - levels[i]) * kDogScale, rounded to nearest.
  void (*difference_rows)(const float* const* levels, std::int16_t* const* dogs, int dogs_count,
                          int width);
  /// How many were found, in the order of layers and columns.
  int (*find_extrema)(const ExtremaRow& row);
  void (*orientations)(const OrientationPatch& patch);
  void (*describe)(const DescriptorPatch& patch);
  void (*compare)(const DistanceBlock& block);
  /// Smallest (distance << kIndexBits | index) of a row of 8 blocks.
  std::int32_t (*nearest)(const std::int32_t* distances, int blocks);
};

const Table& avx2_table();
const Table& baseline_table();

inline const Table& table(Simd simd) { return use_avx2(simd) ? avx2_table() : baseline_table(); }

}  // namespace kestrel::kernels

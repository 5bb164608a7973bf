#pragma once

#include <cstdint>

#include "kestrel/vision/simd.hpp"

/// The inner loops of the vision layer. They are written once (*.inl) and compiled twice, with and
/// without AVX2; they use raw pointers and no inline function of the standard library, whose AVX2
/// copy the linker could otherwise hand to code that runs anywhere. Rows may be read and written up
/// to the next multiple of kRowBlock.
namespace kestrel::kernels {

constexpr int kRowBlock = 16;   // px
constexpr int kMaxRadius = 10;  // taps on each side of a blur's centre
constexpr int kMaxStep = 3;     // px between taps along a row
constexpr int kRowMargin = 32;  // px a blur may read beyond either end of a row
constexpr int kMaxLevels = 8;   // of an octave
constexpr int kBandRows = 8;
constexpr float kFixedScale = 128;  // of grey levels in 16 bits
constexpr int kOrientations = 36;   // bins of the histogram of orientations
constexpr int kGridSide = 18;   // samples of a descriptor's grid, with one around for differences
constexpr int kGridSize = 328;  // kGridSide^2, to a multiple of 8
constexpr int kMaxOrientationRadius = 15;  // samples
constexpr int kIndexBits = 13;             // of a keypoint in the key of a match
constexpr int kQueries = 4;                // descriptors compared at once
constexpr int kModelBlock = 8;             // descriptors interleaved

/// Some rows of a separable blur: first down the columns with taps `step` rows apart, then along
/// the rows; mirrored at the rows' ends (without repeating them).
struct BlurBand {
  const float* const* rows;  // those of the output and radius * step on each side
  const float* taps;         // centre and one side: radius + 1
  int radius;
  int step;
  float* scratch;  // kBandRows rows of stride
  int stride;      // 2 kRowMargin more than the width, rounded up
  int count;       // rows: 1 to kBandRows
  int width;
  float* const* out;           // or null: not kept
  std::int16_t* const* fixed;  // the same in units of 1/kFixedScale, rounded to nearest
};

/// Search of one row for extrema of the differences of Gaussians among their 26 neighbours.
struct ExtremaRow {
  const std::int16_t* const* levels;  // of each: the row above, the row, the row below
  int count;                          // levels: layers + 3
  int begin;                          // columns searched: [begin, end)
  int end;
  int threshold;          // in units of 1/kFixedScale, exceeded by |extrema|
  std::int16_t* scratch;  // 3 layers rows of stride
  int stride;
  std::int32_t* found;  // layer << 16 | column; as many as there are columns times layers
};

/// Gradients about a pixel: (2 radius + 1)^2 samples `step` px apart within the disc.
struct OrientationPatch {
  const std::int16_t* centre;
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
  const std::int16_t* image;
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
  /// Every second of 2 count - 1 numbers in units of 1/kFixedScale, as they are and as floats.
  void (*halve)(const std::int16_t* in, float* out, std::int16_t* fixed, int count);
  void (*blur)(const BlurBand& band);
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

#pragma once

#include <cstddef>
#include <cstdint>

/// The inner loops of the renderer, compiled twice from kernels.inl: for AVX2 and for what every
/// x86-64 has. Neither contracts a product and a sum into one rounding: both give the same bits.
namespace kestrel::sim_detail {

/// 1 / depth of points too far away to be drawn, 1/m: rays that run along a plane.
constexpr float kNearlyAlong = 1e-4f;

/// How a plane's texture is read.
struct Reading {
  /// The four bytes around the place (0, 0), or sixteen, column by column, where a tap has a width.
  const std::uint8_t* texels = nullptr;
  std::int32_t stride = 0;  // bytes
  float last_s = 0;  // places are held to [0, last]: between the first value and the last one
  float last_t = 0;
  float place_from_ray[9] = {};  // (s, t, 1) / depth of a ray (x, y, 1), row by row
  int across =
      1;  // taps: places at even steps along the footprint's sides, of which the mean is taken
  int down = 1;
  float across_s = 0;  // from tap to tap
  float across_t = 0;
  float down_s = 0;
  float down_t = 0;
  float width_s = 0;  // of the rectangle that a tap is the mean over, up to 2; 0: bilinear
  float width_t = 0;
};

/// Adds to light[16 row + k], k from 0 to 15, what the pixels of `rows` rows see whose rays stand
/// at rays[32 row + k] (x) and rays[32 row + 16 + k] (y). Rays that are no numbers, or meet the
/// plane nowhere, see something.
using AddMeanLight = void (*)(const Reading& reading, const float* rays, int rows, float* light);

/// What twelve bits choose between.
constexpr int kQuantiles = 4096;
/// Of a picture whose pixels all have a noise of their own: this many columns at most.
constexpr std::uint32_t kMostColumns = 1u << 16;

/// What becomes of the light of a frame.
struct Sensor {
  float gain = 1;
  float loss = 0;  // of the gain, per px^2 from the picture's centre
  float centre_u = 0;
  float centre_v = 0;
  float noise_grey = 0;
  const float* quantiles = nullptr;  // kQuantiles, of the standard normal
  std::uint32_t seed_low = 0;        // of the frame
  std::uint32_t seed_high = 0;
};

/// Where grey levels go: rows of sixteen pixels, from (u, v) on, u a multiple of sixteen.
struct Patch {
  int u;
  int v;
  int rows;
  std::uint8_t* grey;
  std::ptrdiff_t stride;  // bytes from row to row
};

/// Grey levels of the pixels whose light is light[16 row + k].
using Sense = void (*)(const Sensor& sensor, const float* light, const Patch& patch);

/// One of the two copies.
struct Kernels {
  AddMeanLight add_mean_light;
  Sense sense;
};

void add_mean_light_avx2(const Reading&, const float*, int, float*);
void add_mean_light_baseline(const Reading&, const float*, int, float*);
void sense_avx2(const Sensor&, const float*, const Patch&);
void sense_baseline(const Sensor&, const float*, const Patch&);

inline Kernels kernels(bool avx2) {
  return avx2 ? Kernels{add_mean_light_avx2, sense_avx2}
              : Kernels{add_mean_light_baseline, sense_baseline};
}

}  // namespace kestrel::sim_detail

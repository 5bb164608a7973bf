#pragma once

#include <opencv2/core/mat.hpp>

#include "kestrel/sim/render.hpp"

#include "tile_light.hpp"

namespace kestrel::sim_detail {

/// Turns light into grey levels: gain, vignetting, noise, rounding.
class Exposure {
 public:
  Exposure(cv::Size picture, const RenderOptions& options, Sense sense);

  /// The tile's pixels, of light that is a sum of so many views. The noise of a pixel follows from
  /// seed, frame and place, whoever makes it.
  void expose(const TileLight& light, std::size_t views, const Tile& tile, cv::Mat& picture) const;

 private:
  Sense sense_;
  Sensor sensor_;
};

}  // namespace kestrel::sim_detail

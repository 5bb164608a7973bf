#pragma once

#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/transform.hpp"
#include "kestrel/sim/render.hpp"

#include "bench/stress_texture.hpp"

namespace kestrel::test {

/// A poster on a wall, the same wall without it and with another poster instead, and something that
/// passes before them.
class StressScene {
 public:
  /// Poster of this size at the learned distance, px; on a facade of equal windows when the class
  /// is of the flights, the template then being one window of it for "flight_window".
  StressScene(const std::string& cls, const StressTexture& texture, cv::Size poster_px);

  enum class Shown { Poster, Wall, OtherPoster };
  /// The light, CV_32F, 640x480, grey levels.
  cv::Mat view(const TargetPose& camera_from_target, Shown shown) const;

  /// The occluder (its plane's pose in the target's) over a view.
  void occlude(cv::Mat& light, const TargetPose& camera_from_occluder) const;

 private:
  Renderer poster_;
  Renderer wall_;
  Renderer other_;
  Renderer occluder_;  // on black
  Renderer mask_;      // white where the occluder is
};

/// Size of the poster for a class, px: even sides, the picture's proportions between 2:3 and 3:2,
/// 32 000 px^2 (12 000 for "gust"); 60x46 for "small", 160x170 for the window.
cv::Size poster_size(const std::string& cls, cv::Size picture);

/// Side of the square occluder that hides 40 % of a poster of this size when all of it is before
/// the poster, m.
double occluder_side_m(cv::Size poster_px);

}  // namespace kestrel::test

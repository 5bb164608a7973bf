#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace kestrel::test {

/// What lens, lamp and sensor do to the light of one frame.
struct StressLight {
  double defocus_px = 0;  // standard deviation of the blur
  double gain = 1;        // of the contrast, about the middle grey 128
  double bias_grey = 0;
  /// Across the picture the light changes by this share from the middle to an edge, in direction
  /// shade_angle (rad, from u to v).
  double shade = 0;
  double shade_angle = 0;
  /// A shadow with a soft edge: this share darker beyond a line shadow_at_px from the picture's
  /// centre, in direction shade_angle.
  double shadow = 0;
  double shadow_at_px = 400;
  double noise_grey = 0;  // standard deviation
};

/// The light of frame t of a class; frame 0 of every class is clean. Noise: sigma 8, gain 0.5 to
/// 1.6, bias +-40 grey levels, a shade that turns and a shadow that passes.
StressLight stress_light(const std::string& cls, std::int64_t frame);

/// How much of the time between two frames the shutter is open, 0: an instant.
double stress_exposure(const std::string& cls);

/// Standard normal numbers, drawn once, from which the noise of every frame is taken.
std::vector<float> noise_table(const std::string& name);

/// The picture (CV_32F) as the sensor gives it, 8-bit. The noise depends on name and frame only.
cv::Mat exposed(const cv::Mat& light, const StressLight& how, const std::vector<float>& table,
                const std::string& name);

}  // namespace kestrel::test

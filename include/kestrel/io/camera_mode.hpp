#pragma once

#include <string>
#include <vector>

#include <opencv2/core/types.hpp>

#include "kestrel/io/live_options.hpp"

namespace kestrel {

/// A way in which a camera can send.
struct CameraMode {
  std::string format;            // "grey", "yuyv", "mjpeg", ...; of FireWire "mono8", "yuv411", ...
  cv::Size size;                 // px
  std::vector<double> rates_hz;  // pictures per second; empty: the camera does not say
};

/// A mode and the rate in it.
struct ChosenMode {
  CameraMode mode;
  double rate_hz = 0;  // 0: the camera does not say
};

/// The mode that settings ask for among those of a camera. Whatever is left open: 640 x 480 before
/// the size nearest to it in area, then the format that stands earlier in `formats` (those that are
/// read, the best first), then the highest rate; with rate_hz the lowest rate that reaches it.
/// Throws std::runtime_error that lists what there is when nothing fits.
ChosenMode choose_mode(const std::vector<CameraMode>& modes, const CaptureSettings& settings,
                       const std::vector<std::string>& formats);

/// "yuyv 640x480 at 15, 30 Hz".
std::string to_string(const CameraMode& mode);

}  // namespace kestrel

#pragma once

#include <memory>
#include <optional>
#include <string>

#include "kestrel/vision/frame.hpp"

namespace kestrel {

/// How long a live camera may keep the program waiting.
struct LiveOptions {
  double open_timeout_s = 10;
  double stall_timeout_s = 2;  // without a frame

  /// Throws std::invalid_argument that names the first option that is not positive and finite.
  void check() const;
};

/// A camera that runs by itself: "camera:N" (V4L2), "dc1394" or "dc1394:GUID" (FireWire, see
/// open_dc1394), or a network stream "http://…", "rtsp://…", "udp://…" (FFmpeg). A thread reads
/// every frame and keeps the newest only, so next() is never behind the camera: it waits for a
/// frame it has not given yet. Frames that nobody took are gaps in the index. stamp_s is the
/// monotonic clock when the frame was decoded, counted from the opening. Throws std::runtime_error
/// with a remedy: an address of another kind, no such camera, and in next() a stream that ended or
/// gave no frame for stall_timeout_s.
std::unique_ptr<FrameSource> open_live(const std::string& address, const LiveOptions& options = {});

/// A source whose stamps count from an instant of the machine's monotonic clock.
class LiveClock {
 public:
  virtual ~LiveClock() = default;

  /// What the monotonic clock (std::chrono::steady_clock, s) was when the stamps were zero.
  virtual double stamp_origin_s() const = 0;
};

/// The same of any source; empty for one that does not say, a recording for instance.
std::optional<double> stamp_origin_s(const FrameSource& source);

}  // namespace kestrel

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

namespace kestrel {

/// A picture as a camera gave it.
struct Picture {
  cv::Mat gray;           // 8-bit, a copy of its own; empty: it came damaged
  double captured_s = 0;  // on the machine's monotonic clock, s; see CameraDevice::clock
  std::int64_t lost = 0;  // pictures before it that nobody got
  std::string damage;     // what is wrong when gray is empty
};

/// Whose clock says when a picture was captured.
enum class CaptureClock {
  Driver,   // the camera's driver, when the picture had been exposed and read out
  Arrival,  // this program, when the last of it arrived: exposure and transport come on top
};

/// "driver", "arrival".
const char* name(CaptureClock clock);

/// A camera that is open and sends.
class CameraDevice {
 public:
  virtual ~CameraDevice() = default;

  /// The next picture. Empty when none came within a tenth of a second or so, or when what opened
  /// the camera asked to stop. Throws std::runtime_error (address, cause, remedy) when the camera
  /// is gone: it is to be closed then, and may be opened anew.
  virtual std::optional<Picture> next() = 0;

  virtual CaptureClock clock() const = 0;

  /// What to say, and to do, when it has given no picture for so long: "no picture for 2 s; check
  /// the camera and its cable".
  virtual std::string silence(double seconds) const;
};

/// True when a wait is to end: the source is being closed.
using StopAsked = std::function<bool()>;

/// Opens a camera within timeout_s, where it is one that has to be waited for. Throws
/// std::runtime_error when that fails; also, with any words, once stop says so. The camera may keep
/// stop as long as it lives.
using OpenCamera =
    std::function<std::unique_ptr<CameraDevice>(const StopAsked& stop, double timeout_s)>;

/// Seconds on std::chrono::steady_clock, the machine's monotonic clock (CLOCK_MONOTONIC).
double monotonic_clock_s();

}  // namespace kestrel

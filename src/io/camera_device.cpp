#include "kestrel/io/camera_device.hpp"

#include <chrono>

#include <fmt/format.h>

namespace kestrel {

const char* name(CaptureClock clock) {
  return clock == CaptureClock::Driver ? "driver" : "arrival";
}

std::string CameraDevice::silence(double seconds) const {
  return fmt::format("no picture for {} s; check the camera and its cable", seconds);
}

double monotonic_clock_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace kestrel

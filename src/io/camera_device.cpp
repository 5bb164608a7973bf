#include "kestrel/io/camera_device.hpp"

#include <chrono>

namespace kestrel {

const char* name(CaptureClock clock) {
  return clock == CaptureClock::Driver ? "driver" : "arrival";
}

double monotonic_clock_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace kestrel

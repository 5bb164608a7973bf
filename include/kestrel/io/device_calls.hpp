#pragma once

#include <cstddef>
#include <string>

namespace kestrel {

/// The calls of the operating system that a camera driver is spoken to with, so that the tests can
/// put a camera of their own behind them. As in POSIX: -1 (map: null) for a failure, whose cause is
/// in errno.
class DeviceCalls {
 public:
  virtual ~DeviceCalls() = default;
  /// Opens a device to read and write, without waiting in its calls; the descriptor.
  virtual int open(const std::string& path) = 0;
  virtual void close(int descriptor) = 0;
  /// Repeated when a signal breaks it off.
  virtual int control(int descriptor, unsigned long request, void* argument) = 0;
  /// Shared memory of the device.
  virtual void* map(int descriptor, std::size_t bytes, std::size_t offset) = 0;
  virtual void unmap(void* start, std::size_t bytes) = 0;
  /// Waits until there is something to read: 1, or 0 after wait_ms, -1 also for a device that was
  /// taken away (errno ENODEV).
  virtual int wait_readable(int descriptor, int wait_ms) = 0;
};

/// Those of the system. It has no state: any number of threads may use it.
DeviceCalls& system_calls();

}  // namespace kestrel

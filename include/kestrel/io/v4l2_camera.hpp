#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kestrel/io/camera_device.hpp"
#include "kestrel/io/camera_mode.hpp"
#include "kestrel/io/device_calls.hpp"

namespace kestrel {

/// A camera that Linux drives (USB, built-in), through V4L2's own interface: pictures in memory
/// that is shared with the driver, stamped by it on the monotonic clock where it says so (UVC and
/// most others do). Pictures that the driver's count passes over are Picture::lost; one that it
/// marks as faulty, or that is cut short, is damaged. next() throws when the camera is unplugged or
/// the driver reports an error.
///
/// place: the N of /dev/videoN, or a path, e.g. below /dev/v4l/by-id. Throws std::runtime_error
/// (what is wrong, what to do): no such device, one that captures no video, one that is in use, no
/// mode as settings ask for, and a driver that then sets another.
std::unique_ptr<CameraDevice> open_v4l2(const std::string& place, const CaptureSettings& settings,
                                        DeviceCalls& calls = system_calls());

/// A camera as it is found.
struct V4l2Listing {
  std::string path;  // /dev/videoN
  std::string name;  // what the camera calls itself
  std::string bus;   // where it is plugged in
  std::vector<CameraMode> modes;
  std::string trouble;  // why it could not be asked; empty: it could
};

/// The devices /dev/video0 to /dev/video63 that capture video. A size that may be anything between
/// two is listed as both.
std::vector<V4l2Listing> list_v4l2(DeviceCalls& calls = system_calls());

}  // namespace kestrel

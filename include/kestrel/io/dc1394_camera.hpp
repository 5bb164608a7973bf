#pragma once

#include <memory>
#include <string>

#include "kestrel/vision/frame.hpp"

namespace kestrel {

/// A FireWire (IIDC) camera on libdc1394: guid in hexadecimal, empty for the first on the bus. It
/// is set to 8-bit grey where it can (else colour, turned to grey), 640x480 before larger images,
/// at its highest rate. next() gives the newest frame of the ring buffer, stamped with the
/// monotonic clock when it is taken out; older ones are gaps in the index, a frame that arrived
/// corrupt is named in skipped(). Throws std::runtime_error when there is no such camera, when the
/// bus reports an error, and in next() after timeout_s without a frame (a camera that was
/// unplugged is not reported by the bus: it only falls silent).
std::unique_ptr<FrameSource> open_dc1394(const std::string& guid, double timeout_s = 2);

}  // namespace kestrel

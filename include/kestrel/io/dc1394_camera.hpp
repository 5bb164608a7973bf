#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/io/camera_device.hpp"
#include "kestrel/io/camera_mode.hpp"

namespace kestrel {

/// A FireWire (IIDC) camera on libdc1394: guid in hexadecimal, empty for the first on the bus. Its
/// formats are "mono8", "mono16", "yuv422", "yuv444", "yuv411", "rgb8", "rgb16" and, of Format7
/// (the whole picture only), also "raw8" and "raw16", whose Bayer pattern is decoded. With
/// settings.trigger each picture waits for its trigger; "software" triggers settings.rate_hz
/// pictures a second, or each when the last one came. Pictures carry the time at which the bus had
/// filled them in (libdc1394's stamp, brought to the monotonic clock); one that is old when it is
/// taken is lost to the next, one that arrived corrupt is damaged. next() throws when the bus
/// reports an error; a camera that is unplugged is not reported by the bus, it only falls silent.
/// Throws std::runtime_error when there is no such camera, no mode or trigger as settings ask for,
/// or no bandwidth.
std::unique_ptr<CameraDevice> open_dc1394(const std::string& guid, const CaptureSettings& settings);

/// What can trigger a camera.
struct TriggerAbility {
  std::vector<std::string> sources;  // as TriggerSettings::source
  std::vector<int> modes;            // IIDC's numbers
  bool has_polarity = false;         // that can be chosen
};

/// "sources 0, software; modes 0, 14; polarity high or low".
std::string to_string(const TriggerAbility& trigger);

/// A camera on the bus.
struct Dc1394Listing {
  std::string guid;  // 16 hexadecimal digits
  std::string name;  // vendor and model
  std::vector<CameraMode> modes;
  std::optional<TriggerAbility> trigger;
  std::string trouble;  // why it could not be asked; empty: it could
};

/// The cameras on the FireWire bus; none where there is no bus.
std::vector<Dc1394Listing> list_dc1394();

}  // namespace kestrel

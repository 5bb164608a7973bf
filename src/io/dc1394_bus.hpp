#pragma once

#include <memory>
#include <string>
#include <vector>

#include <dc1394/dc1394.h>

#include "kestrel/io/camera_mode.hpp"

namespace kestrel::iidc {

/// Releases with the library's own functions.
struct Release {
  void operator()(dc1394_t* bus) const { dc1394_free(bus); }
  void operator()(dc1394camera_list_t* list) const { dc1394_camera_free_list(list); }
  void operator()(dc1394camera_t* camera) const { dc1394_camera_free(camera); }
};
using Bus = std::unique_ptr<dc1394_t, Release>;
using CameraList = std::unique_ptr<dc1394camera_list_t, Release>;
using Camera = std::unique_ptr<dc1394camera_t, Release>;

/// Throws std::runtime_error that begins with "dc1394: ".
[[noreturn]] void fail(const std::string& what);

/// Throws when a call failed, with the library's word for it.
void require(dc1394error_t error, const char* doing);

/// The cameras on the bus; throws when it cannot be asked.
CameraList cameras_on(dc1394_t& bus);

/// The camera that is wanted: hexadecimal digits, or none for the first. Throws when it is not
/// there.
std::uint64_t guid_of(const dc1394camera_list_t& list, const std::string& wanted);

/// A mode and the library's word for it.
struct Mode {
  CameraMode mode;
  dc1394video_mode_t id;
  dc1394color_coding_t coding;
};

/// The formats that are read, the best first.
const std::vector<std::string>& formats();

/// The modes of a camera in those formats, the usual ones before Format7.
std::vector<Mode> modes_of(dc1394camera_t& camera);

/// Sets a mode and a rate (1/s; of Format7 the highest there is), at the highest speed of the bus.
void set_mode(dc1394camera_t& camera, const Mode& mode, double rate_hz);

}  // namespace kestrel::iidc

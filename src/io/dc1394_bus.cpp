#include "dc1394_bus.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace kestrel::iidc {
namespace {

/// The name of a format; empty for one that is not read.
std::string name_of(dc1394color_coding_t coding) {
  switch (coding) {
    case DC1394_COLOR_CODING_MONO8:
      return "mono8";
    case DC1394_COLOR_CODING_MONO16:
      return "mono16";
    case DC1394_COLOR_CODING_YUV422:
      return "yuv422";
    case DC1394_COLOR_CODING_YUV444:
      return "yuv444";
    case DC1394_COLOR_CODING_YUV411:
      return "yuv411";
    case DC1394_COLOR_CODING_RGB8:
      return "rgb8";
    case DC1394_COLOR_CODING_RGB16:
      return "rgb16";
    case DC1394_COLOR_CODING_RAW8:
      return "raw8";
    case DC1394_COLOR_CODING_RAW16:
      return "raw16";
    default:
      return "";
  }
}

bool is_format7(dc1394video_mode_t mode) {
  return dc1394_is_video_mode_scalable(mode) == DC1394_TRUE;
}

std::vector<double> rates_of(dc1394camera_t& camera, dc1394video_mode_t mode) {
  dc1394framerates_t rates{};
  std::vector<double> hz;
  if (dc1394_video_get_supported_framerates(&camera, mode, &rates) != DC1394_SUCCESS) return hz;
  for (std::uint32_t i = 0; i < rates.num; ++i) {
    float rate = 0;
    if (dc1394_framerate_as_float(rates.framerates[i], &rate) == DC1394_SUCCESS)
      hz.push_back(double(rate));
  }
  return hz;
}

std::optional<Mode> usual_mode(dc1394camera_t& camera, dc1394video_mode_t id) {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  dc1394color_coding_t coding{};
  const bool known =
      dc1394_get_image_size_from_video_mode(&camera, id, &width, &height) == DC1394_SUCCESS &&
      dc1394_get_color_coding_from_video_mode(&camera, id, &coding) == DC1394_SUCCESS;
  if (!known || name_of(coding).empty()) return std::nullopt;
  return Mode{{name_of(coding), {int(width), int(height)}, rates_of(camera, id)}, id, coding};
}

/// Of Format7: the whole picture. How fast it is the camera does not say.
std::vector<Mode> scalable_modes(dc1394camera_t& camera, dc1394video_mode_t id) {
  std::vector<Mode> modes;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  dc1394color_codings_t codings{};
  if (dc1394_format7_get_max_image_size(&camera, id, &width, &height) != DC1394_SUCCESS ||
      dc1394_format7_get_color_codings(&camera, id, &codings) != DC1394_SUCCESS)
    return modes;
  for (std::uint32_t i = 0; i < codings.num; ++i) {
    const dc1394color_coding_t coding = codings.codings[i];
    if (name_of(coding).empty()) continue;
    modes.push_back({{name_of(coding), {int(width), int(height)}, {}}, id, coding});
  }
  return modes;
}

void set_rate(dc1394camera_t& camera, dc1394video_mode_t mode, double rate_hz) {
  dc1394framerates_t rates{};
  require(dc1394_video_get_supported_framerates(&camera, mode, &rates), "asking for its rates");
  if (rates.num == 0) fail("the camera names no frame rate");
  dc1394framerate_t best = rates.framerates[0];
  double best_miss_hz = HUGE_VAL;
  for (std::uint32_t i = 0; i < rates.num; ++i) {
    float hz = 0;
    dc1394_framerate_as_float(rates.framerates[i], &hz);
    const double miss_hz = std::abs(double(hz) - rate_hz);
    if (!(miss_hz < best_miss_hz)) continue;
    best = rates.framerates[i];
    best_miss_hz = miss_hz;
  }
  require(dc1394_video_set_framerate(&camera, best), "setting the rate");
}

/// 800 Mbit/s where camera and bus can, else 400.
void set_speed(dc1394camera_t& camera) {
  if (camera.bmode_capable == DC1394_TRUE &&
      dc1394_video_set_operation_mode(&camera, DC1394_OPERATION_MODE_1394B) == DC1394_SUCCESS &&
      dc1394_video_set_iso_speed(&camera, DC1394_ISO_SPEED_800) == DC1394_SUCCESS)
    return;
  require(dc1394_video_set_iso_speed(&camera, DC1394_ISO_SPEED_400), "setting the speed");
}

}  // namespace

void fail(const std::string& what) { throw std::runtime_error("dc1394: " + what); }

void require(dc1394error_t error, const char* doing) {
  if (error != DC1394_SUCCESS) fail(fmt::format("{}: {}", doing, dc1394_error_get_string(error)));
}

CameraList cameras_on(dc1394_t& bus) {
  dc1394camera_list_t* list = nullptr;
  require(dc1394_camera_enumerate(&bus, &list), "looking for cameras");
  return CameraList(list);
}

std::uint64_t guid_of(const dc1394camera_list_t& list, const std::string& wanted) {
  if (list.num == 0) fail("no camera on the FireWire bus; connect one, and check /dev/fw*");
  if (wanted.empty()) return list.ids[0].guid;
  std::uint64_t guid = 0;
  const char* end = wanted.data() + wanted.size();
  const auto read = std::from_chars(wanted.data(), end, guid, 16);
  if (read.ec != std::errc() || read.ptr != end) {
    fail("'" + wanted + "' is no GUID; give 16 hexadecimal digits");
  }
  std::string others;
  for (std::uint32_t i = 0; i < list.num; ++i) {
    if (list.ids[i].guid == guid) return guid;
    others += fmt::format(" {:016x}", list.ids[i].guid);
  }
  fail(fmt::format("no camera {:016x} on the bus; there is{}", guid, others));
}

const std::vector<std::string>& formats() {
  static const std::vector<std::string> all = {"mono8", "mono16", "yuv422", "yuv444", "yuv411",
                                               "rgb8",  "rgb16",  "raw8",   "raw16"};
  return all;
}

std::vector<Mode> modes_of(dc1394camera_t& camera) {
  dc1394video_modes_t ids{};
  require(dc1394_video_get_supported_modes(&camera, &ids), "asking for its modes");
  std::vector<Mode> usual;
  std::vector<Mode> scalable;
  for (std::uint32_t i = 0; i < ids.num; ++i) {
    if (is_format7(ids.modes[i])) {
      const std::vector<Mode> more = scalable_modes(camera, ids.modes[i]);
      scalable.insert(scalable.end(), more.begin(), more.end());
    } else if (const auto mode = usual_mode(camera, ids.modes[i])) {
      usual.push_back(*mode);
    }
  }
  usual.insert(usual.end(), scalable.begin(), scalable.end());
  return usual;
}

void set_mode(dc1394camera_t& camera, const Mode& mode, double rate_hz) {
  set_speed(camera);
  require(dc1394_video_set_mode(&camera, mode.id), "setting the mode");
  if (!is_format7(mode.id)) return set_rate(camera, mode.id, rate_hz);
  require(dc1394_format7_set_roi(&camera, mode.id, mode.coding, DC1394_USE_MAX_AVAIL, 0, 0,
                                 mode.mode.size.width, mode.mode.size.height),
          "setting the whole picture of Format7");
}

}  // namespace kestrel::iidc

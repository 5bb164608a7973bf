#include <cerrno>
#include <stdexcept>

#include <fmt/format.h>

#include "v4l2_device.hpp"

namespace kestrel {
namespace {

constexpr int kHighestNumber = 63;

template <std::size_t N>
std::string text_of(const __u8 (&bytes)[N]) {
  std::string text;
  for (const __u8 byte : bytes) {
    if (byte == 0) break;
    text += char(byte);
  }
  return text;
}

/// What a node is; empty for one that is not there or captures no video.
std::optional<V4l2Listing> listing_of(const std::string& path, DeviceCalls& calls) {
  V4l2Listing it{path, "", "", {}, ""};
  const int descriptor = calls.open(path);
  if (descriptor < 0 && (errno == ENOENT || errno == ENXIO || errno == ENODEV)) return std::nullopt;
  if (descriptor >= 0) calls.close(descriptor);
  try {
    const V4l2Device device(path, calls);
    const v4l2_capability can = capability(device);
    if (!captures_video(can)) return std::nullopt;
    it.name = text_of(can.card);
    it.bus = text_of(can.bus_info);
    it.modes = modes_of(device, std::nullopt);
  } catch (const std::runtime_error& error) {
    it.trouble = error.what();
  }
  return it;
}

}  // namespace

std::vector<V4l2Listing> list_v4l2(DeviceCalls& calls) {
  std::vector<V4l2Listing> cameras;
  for (int number = 0; number <= kHighestNumber; ++number) {
    auto camera = listing_of(fmt::format("/dev/video{}", number), calls);
    if (camera) cameras.push_back(std::move(*camera));
  }
  return cameras;
}

}  // namespace kestrel

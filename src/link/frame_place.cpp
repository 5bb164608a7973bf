#include "kestrel/link/frame_place.hpp"

#include <stdexcept>

namespace kestrel {
namespace {

constexpr std::string_view kScheme = "udp://";  // as parse_address wants it

}  // namespace

FramePlace parse_frame_place(std::string_view text) {
  if (text.find('/') != std::string_view::npos) return {{}, std::filesystem::path(text)};
  try {
    return {parse_address(std::string(kScheme) + std::string(text)), {}};
  } catch (const std::invalid_argument&) {
    throw std::invalid_argument("'" + std::string(text) +
                                "' is no place for frames: write 127.0.0.1:14570, [::1]:14570, or "
                                "the path of a local socket with a '/' in it, ./frames");
  }
}

std::string to_string(const FramePlace& place) {
  return place.is_local() ? place.path.string() : to_string(place.address).substr(kScheme.size());
}

}  // namespace kestrel

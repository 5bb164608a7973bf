#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "kestrel/link/address.hpp"

namespace kestrel {

/// Where frames are served: TCP, or a local (Unix-domain) socket when there is a path.
struct FramePlace {
  Address address;
  std::filesystem::path path;  // empty: TCP

  bool is_local() const { return !path.empty(); }
};

/// The place of "127.0.0.1:14570", "[::1]:14570" or "localhost:14570", or of a path: a text with a
/// '/'. Throws std::invalid_argument that says what is wrong.
FramePlace parse_frame_place(std::string_view text);

/// As parse_frame_place reads it.
std::string to_string(const FramePlace& place);

}  // namespace kestrel

#pragma once

#include <string>

namespace kestrel {

/// What stands behind the address of a source of frames.
enum class SourceKind {
  Sequence,    // sequence:FILE, a description (sequences/README.md)
  Images,      // images:PATTERN or a folder
  Video,       // video:FILE
  V4l2,        // camera:N or camera:/dev/..., USB and built-in cameras
  Dc1394,      // dc1394:GUID, or dc1394 for the first one: FireWire
  Network,     // rtsp://, rtp:, udp://, http://, https://
  Simulated,   // sim:HOST:PORT or sim:PATH, frames of another program (link/frame_header)
  Simulation,  // simulation: the built-in world
};

/// An address of a source, taken apart.
struct SourceAddress {
  SourceKind kind = SourceKind::Simulation;
  std::string text;   // as written
  std::string place;  // what follows "kind:"; of a network stream the whole address
};

/// The source that a text names. Throws std::invalid_argument that lists all schemes for any other
/// text, and the nearest one for a scheme that is misspelt.
SourceAddress parse_source(const std::string& text);

/// True when the text begins with one of the schemes (or is one that stands alone).
bool is_source_address(const std::string& text);

/// True for what runs by itself and cannot wait: cameras and network streams.
bool is_live(SourceKind kind);

}  // namespace kestrel

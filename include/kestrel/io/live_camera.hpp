#pragma once

#include <memory>
#include <string>

#include "kestrel/io/live_source.hpp"

namespace kestrel {

/// The camera or stream of an address (see parse_source): camera:N (open_v4l2), dc1394 or
/// dc1394:GUID (open_dc1394), rtsp://, rtp:, udp://, http:// (open_network). A camera must be there
/// at once; a stream is waited for until open_timeout_s. Throws std::invalid_argument for an
/// address of another kind and for capture settings of a stream, std::runtime_error with a remedy
/// when it does not open.
std::unique_ptr<LiveSource> open_live(const std::string& address, const LiveOptions& options = {});

}  // namespace kestrel

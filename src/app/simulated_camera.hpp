#pragma once

#include <memory>
#include <string>

#include "kestrel/io/live_source.hpp"

namespace kestrel::app {

/// As kestrel::open_live, and also "sim:HOST:PORT" or "sim:PATH": the camera of
/// `kestrel simulate --real-time`, or of any program that serves frames as link/frame_header has
/// them. Its stamps are captures, by this machine's clock.
std::unique_ptr<LiveSource> open_camera(const std::string& address,
                                        const LiveOptions& options = {});

}  // namespace kestrel::app

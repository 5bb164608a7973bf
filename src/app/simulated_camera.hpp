#pragma once

#include <memory>
#include <string>

#include "kestrel/vision/frame.hpp"

namespace kestrel::app {

/// The camera of `kestrel simulate --real-time` (or of any program that serves frames as
/// link/frame_header has them) as a live source: "HOST:PORT" or the path of a local socket. Waits
/// up to 10 s for the first frame, then up to 2 s for each; connects again when the stream breaks,
/// and names what was wrong among the frames passed over. Stamps are captures, by this machine's
/// clock. Throws std::invalid_argument for another text; next() throws when no frame comes.
std::unique_ptr<FrameSource> open_simulated_camera(const std::string& place);

}  // namespace kestrel::app

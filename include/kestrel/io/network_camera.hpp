#pragma once

#include <memory>
#include <string>

#include "kestrel/io/camera_device.hpp"

namespace kestrel {

/// How long a sender may keep us waiting.
struct NetworkPatience {
  double open_timeout_s = 10;
  double stall_timeout_s = 2;  // for each picture
};

/// A video that comes over the network, read with FFmpeg's libraries: rtsp://…, udp://… (MPEG-TS),
/// http://… and https://… (MJPEG as cameras send it, or any container), rtp://… (kinds of payload
/// that need no description: MPEG-TS, JPEG, MPEG video) and rtp:FILE.sdp (a session description
/// for all others). What answers may lead nowhere but to the network. captured_s is when the last
/// piece of the picture arrived; pieces that were lost on the way are not counted, as no protocol
/// tells all of them. next() throws when the stream ends, or when no whole picture came for
/// stall_timeout_s. Throws std::runtime_error when nobody answers or the answer is no video. The
/// look-up of a host's name cannot be interrupted.
std::unique_ptr<CameraDevice> open_network(const std::string& address, NetworkPatience patience,
                                           const StopAsked& stop);

}  // namespace kestrel

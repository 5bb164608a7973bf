#include "kestrel/io/live_camera.hpp"

#include <stdexcept>

#include "kestrel/io/dc1394_camera.hpp"
#include "kestrel/io/network_camera.hpp"
#include "kestrel/io/source_address.hpp"
#include "kestrel/io/v4l2_camera.hpp"

namespace kestrel {
namespace {

OpenCamera opener(const SourceAddress& source, const LiveOptions& options) {
  const std::string place = source.place;
  const CaptureSettings capture = options.capture;
  if (source.kind == SourceKind::V4l2 && capture.trigger)
    throw std::invalid_argument(source.text +
                                ": trigger: only a FireWire camera (dc1394) is triggered from "
                                "here; remove the key");
  if (source.kind == SourceKind::V4l2) {
    return [place, capture](const StopAsked&, double) { return open_v4l2(place, capture); };
  }
  if (source.kind == SourceKind::Dc1394) {
    return [place, capture](const StopAsked&, double) { return open_dc1394(place, capture); };
  }
  const double stall_s = options.stall_timeout_s;
  return [place, stall_s](const StopAsked& stop, double timeout_s) {
    return open_network(place, {timeout_s, stall_s}, stop);
  };
}

}  // namespace

std::unique_ptr<LiveSource> open_live(const std::string& address, const LiveOptions& options) {
  const SourceAddress source = parse_source(address);
  if (!is_live(source.kind) || source.kind == SourceKind::Simulated) {
    throw std::invalid_argument("'" + address +
                                "' is no live camera; give camera:N, dc1394:GUID, or an address "
                                "that begins with rtsp://, rtp:, udp:// or http://");
  }
  const bool is_stream = source.kind == SourceKind::Network;
  if (is_stream && !options.capture.is_empty()) {
    throw std::invalid_argument(address +
                                ": a network stream comes as it is sent; set format, size, rate, "
                                "exposure and gain at the camera, not here");
  }
  return std::make_unique<LiveSource>(address, opener(source, options), options,
                                      is_stream ? FirstOpening::UntilTimeout : FirstOpening::Once);
}

}  // namespace kestrel

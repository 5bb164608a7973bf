#include "kestrel/link/link_port.hpp"

namespace kestrel {
namespace {

using Ports = std::variant<DatagramPort, StreamPort>;

Ports opened(const LinkPlace& place, const PortOptions& options, std::size_t number,
             Poller& poller) {
  if (is_stream(place.kind)) {
    return Ports(std::in_place_type<StreamPort>, place, options, number, poller);
  }
  return Ports(std::in_place_type<DatagramPort>, place, options, number, poller);
}

}  // namespace

LinkPort::LinkPort(const LinkPlace& place, const PortOptions& options, std::size_t number,
                   Poller& poller)
    : port_(opened(place, options, number, poller)) {}

std::optional<PortEvent> LinkPort::next(std::uint64_t tag, double now_s) noexcept {
  return std::visit([&](auto& port) { return port.next(tag, now_s); }, port_);
}

std::optional<PortEvent> LinkPort::due(double now_s) noexcept {
  return std::visit([&](auto& port) { return port.due(now_s); }, port_);
}

void LinkPort::send(PeerId peer, Bytes frame) noexcept {
  std::visit([&](auto& port) { port.send(peer, frame); }, port_);
}

Address LinkPort::address() const {
  return std::visit([](const auto& port) { return port.address(); }, port_);
}

PortCounts LinkPort::counts() const {
  return std::visit([](const auto& port) { return port.counts(); }, port_);
}

PeerTraffic LinkPort::traffic(PeerId peer) const {
  return std::visit([&](const auto& port) { return port.traffic(peer); }, port_);
}

}  // namespace kestrel

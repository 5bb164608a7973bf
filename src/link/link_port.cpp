#include "kestrel/link/link_port.hpp"

#include "kestrel/link/datagram_port.hpp"
#include "kestrel/link/stream_port.hpp"

namespace kestrel {

LinkPort::LinkPort(const LinkPlace& place, const PortOptions& options, std::size_t number)
    : place_(place), options_(options), numbers_(number), tag_(std::uint64_t(number) << 32) {
  options_.check();
}

std::unique_ptr<LinkPort> open_link_port(const LinkPlace& place, const PortOptions& options,
                                         std::size_t number, Poller& poller) {
  if (is_stream(place.kind)) {
    return std::make_unique<StreamPort>(place, options, number, poller);
  }
  return std::make_unique<DatagramPort>(place, options, number, poller);
}

}  // namespace kestrel

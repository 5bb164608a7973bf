#pragma once

#include <string>
#include <string_view>

#include "kestrel/link/address.hpp"

namespace kestrel {

/// How bytes come and go, and who begins.
enum class LinkKind {
  UdpClient,  // one peer, known beforehand
  UdpServer,  // whoever sends a datagram here
  TcpClient,  // connects, and connects again
  TcpServer,  // whoever connects here
};

constexpr bool is_stream(LinkKind kind) {
  return kind == LinkKind::TcpClient || kind == LinkKind::TcpServer;
}
constexpr bool is_server(LinkKind kind) {
  return kind == LinkKind::UdpServer || kind == LinkKind::TcpServer;
}

/// Where a link is, and how it is spoken.
struct LinkPlace {
  LinkKind kind = LinkKind::UdpServer;
  Address address;
};

/// The place of "udp://HOST:PORT" (sends there), "udp-listen://HOST:PORT" (hears there),
/// "tcp://HOST:PORT" or "tcp-listen://HOST:PORT"; hosts as parse_address reads them. Throws
/// std::invalid_argument that says what is wrong, for a client also of port 0 and "any" hosts.
LinkPlace parse_link_place(std::string_view text);

/// As parse_link_place reads it.
std::string to_string(const LinkPlace& place);

}  // namespace kestrel

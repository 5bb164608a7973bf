#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace kestrel {

/// Where datagrams go to or come from. The host is a number, never a name: a name server that is
/// slow or wrong must not decide where commands go.
struct Address {
  std::string host;        // "127.0.0.1" or "::1", in the canonical spelling
  std::uint16_t port = 0;  // 0: any free port, for a receiver

  bool is_ipv6() const { return host.find(':') != std::string::npos; }
  /// True for "0.0.0.0" and "::", which mean every interface of this machine.
  bool is_any() const { return host == "0.0.0.0" || host == "::"; }
};

bool operator==(const Address& a, const Address& b);
bool operator!=(const Address& a, const Address& b);
bool operator<(const Address& a, const Address& b);

/// The address of "udp://127.0.0.1:5005", "udp://[::1]:5005" or "udp://localhost:5005" (which is
/// 127.0.0.1). Throws std::invalid_argument that says what is wrong and how to write it.
Address parse_address(std::string_view text);

/// As parse_address reads it.
std::string to_string(const Address& address);

}  // namespace kestrel

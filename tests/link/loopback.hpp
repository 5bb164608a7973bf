#pragma once

#include <stdexcept>
#include <vector>

#include "kestrel/link/socket.hpp"

namespace kestrel::test {

/// Loopback, IPv6 where the machine has it.
inline std::vector<Address> loopbacks() {
  std::vector<Address> found = {{"127.0.0.1", 0}};
  try {
    UdpSocket::bound_to({"::1", 0});
    found.push_back({"::1", 0});
  } catch (const std::runtime_error&) {
    // no IPv6 here
  }
  return found;
}

/// Longer than loopback ever takes: only a test that fails waits for it.
constexpr double kPatience_s = 5;

/// A port of loopback where nobody listens: it was free a moment ago.
inline Address deaf_port() { return UdpSocket::bound_to({"127.0.0.1", 0}).local(); }

}  // namespace kestrel::test

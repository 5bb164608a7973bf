#include "socket_address.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include <arpa/inet.h>

namespace kestrel {

SocketAddress socket_address(const Address& address) {
  SocketAddress spelled;
  int understood = 0;
  if (address.is_ipv6()) {
    sockaddr_in6 in{};
    in.sin6_family = AF_INET6;
    in.sin6_port = htons(address.port);
    understood = inet_pton(AF_INET6, address.host.c_str(), &in.sin6_addr);
    spelled.size = sizeof in;
    std::memcpy(&spelled.storage, &in, sizeof in);
  } else {
    sockaddr_in in{};
    in.sin_family = AF_INET;
    in.sin_port = htons(address.port);
    understood = inet_pton(AF_INET, address.host.c_str(), &in.sin_addr);
    spelled.size = sizeof in;
    std::memcpy(&spelled.storage, &in, sizeof in);
  }
  if (understood != 1) throw std::invalid_argument(to_string(address) + ": not an address");
  return spelled;
}

Address address_of(const SocketAddress& spelled) {
  std::array<char, INET6_ADDRSTRLEN> host{};
  if (spelled.storage.ss_family == AF_INET6) {
    sockaddr_in6 in{};
    std::memcpy(&in, &spelled.storage, sizeof in);
    inet_ntop(AF_INET6, &in.sin6_addr, host.data(), host.size());
    return {host.data(), ntohs(in.sin6_port)};
  }
  sockaddr_in in{};
  std::memcpy(&in, &spelled.storage, sizeof in);
  inet_ntop(AF_INET, &in.sin_addr, host.data(), host.size());
  return {host.data(), ntohs(in.sin_port)};
}

Address local_address(int descriptor) {
  SocketAddress spelled;
  if (::getsockname(descriptor, spelled.get(), &spelled.size) != 0) return {};
  return address_of(spelled);
}

void fail_at(const std::string& place, const char* what) {
  const int reason = errno;
  throw std::runtime_error(place + ": " + what + ": " + std::system_category().message(reason));
}

int open_socket(const Address& address, int type) {
  const int family = address.is_ipv6() ? AF_INET6 : AF_INET;
  const int descriptor = ::socket(family, type | SOCK_CLOEXEC, 0);
  if (descriptor < 0) fail_at(to_string(address), "cannot open a socket");
  const int only = 1;
  if (address.is_ipv6()) {
    ::setsockopt(descriptor, IPPROTO_IPV6, IPV6_V6ONLY, &only, sizeof only);
  }
  return descriptor;
}

}  // namespace kestrel

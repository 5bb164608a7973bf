#pragma once

#include <string>
#include <utility>

#include <sys/socket.h>

#include "kestrel/link/address.hpp"

namespace kestrel {

/// An address as the kernel spells it.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = sizeof(sockaddr_storage);

  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

/// Throws std::invalid_argument for a host that is no number.
SocketAddress socket_address(const Address& address);

Address address_of(const SocketAddress& spelled);

/// This end of a socket; an empty one when the kernel does not say.
Address local_address(int descriptor);

/// Throws std::runtime_error with the reason that errno holds.
[[noreturn]] void fail_at(const std::string& place, const char* what);

/// A socket of the address's family; "::" hears IPv6 alone on every machine, whatever its default.
/// Throws std::runtime_error.
int open_socket(const Address& address, int type);

}  // namespace kestrel

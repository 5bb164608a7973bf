#pragma once

#include <cstdint>
#include <stdexcept>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace kestrel::test {

/// A socket of a kind (SOCK_STREAM, SOCK_DGRAM) at a port of the loopback.
inline int bound_socket(int kind, int port) {
  const int made = socket(AF_INET, kind, 0);
  const int yes = 1;
  setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(std::uint16_t(port));
  if (bind(made, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("no port on the loopback");
  return made;
}

/// One that is listened at.
inline int listening_socket(int port) {
  const int made = bound_socket(SOCK_STREAM, port);
  listen(made, 4);
  return made;
}

}  // namespace kestrel::test

#include "link/relay_socket.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <system_error>
#include <utility>

#include <arpa/inet.h>
#include <unistd.h>

namespace kestrel::test {
namespace {

Descriptor open_socket(const Address& address, int type) {
  const int family = address.is_ipv6() ? AF_INET6 : AF_INET;
  return {socket(family, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0), "socket"};
}

void require(int result, const char* what) {
  if (result < 0) throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

Descriptor::Descriptor(int descriptor, const char* what) : descriptor_(descriptor) {
  require(descriptor, what);
}
Descriptor::Descriptor(Descriptor&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}
Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}
Descriptor::~Descriptor() {
  if (descriptor_ >= 0) close(descriptor_);
}

SystemAddress::SystemAddress(const Address& address) {
  if (address.is_ipv6()) {
    auto* six = reinterpret_cast<sockaddr_in6*>(&storage);
    six->sin6_family = AF_INET6;
    six->sin6_port = htons(address.port);
    inet_pton(AF_INET6, address.host.c_str(), &six->sin6_addr);
    size = sizeof *six;
  } else {
    auto* four = reinterpret_cast<sockaddr_in*>(&storage);
    four->sin_family = AF_INET;
    four->sin_port = htons(address.port);
    inet_pton(AF_INET, address.host.c_str(), &four->sin_addr);
    size = sizeof *four;
  }
}

Address SystemAddress::address() const {
  char host[INET6_ADDRSTRLEN] = "";
  if (storage.ss_family == AF_INET6) {
    const auto* six = reinterpret_cast<const sockaddr_in6*>(&storage);
    inet_ntop(AF_INET6, &six->sin6_addr, host, sizeof host);
    return {host, ntohs(six->sin6_port)};
  }
  const auto* four = reinterpret_cast<const sockaddr_in*>(&storage);
  inet_ntop(AF_INET, &four->sin_addr, host, sizeof host);
  return {host, ntohs(four->sin_port)};
}

Descriptor bound_socket(const Address& at, int type) {
  Descriptor opened = open_socket(at, type);
  const int yes = 1;
  if (type == SOCK_STREAM) setsockopt(opened.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const SystemAddress address(at);
  require(bind(opened.get(), address.get(), address.size), "bind");
  if (type == SOCK_STREAM) require(listen(opened.get(), 16), "listen");
  return opened;
}

Descriptor connected_socket(const Address& to, int type) {
  Descriptor opened = open_socket(to, type);
  const SystemAddress address(to);
  if (connect(opened.get(), address.get(), address.size) < 0 && errno != EINPROGRESS) {
    throw std::system_error(errno, std::generic_category(), "connect");
  }
  return opened;
}

Address local_address(const Descriptor& socket) {
  SystemAddress address;
  require(getsockname(socket.get(), address.get(), &address.size), "getsockname");
  return address.address();
}

ReadResult read_some(const Descriptor& socket) {
  ReadResult result;
  std::vector<std::uint8_t> buffer(65536);
  const ssize_t got =
      recvfrom(socket.get(), buffer.data(), buffer.size(), 0, result.from.get(), &result.from.size);
  if (got < 0) {
    result.broken = errno != EAGAIN && errno != EINTR;
    return result;
  }
  buffer.resize(std::size_t(got));
  result.bytes = std::move(buffer);
  return result;
}

void wait_ready(std::vector<pollfd>& sockets, double until_s) {
  const double wait_s = std::clamp(until_s - monotonic_s(), 0.0, 1.0);
  const double whole_s = std::floor(wait_s);
  const timespec wait{time_t(whole_s), long((wait_s - whole_s) * 1e9)};
  ppoll(sockets.data(), sockets.size(), &wait, nullptr);
}

}  // namespace kestrel::test

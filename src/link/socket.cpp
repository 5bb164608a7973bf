#include "kestrel/link/socket.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace kestrel {
namespace {

constexpr std::size_t kMaxDatagram = 65536;  // no UDP datagram is larger
constexpr double kLongestWait_s = 1e6;

/// An address as the kernel spells it.
struct Endpoint {
  sockaddr_storage storage{};
  socklen_t size = sizeof(sockaddr_storage);

  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

Endpoint endpoint(const Address& address) {
  Endpoint end;
  int understood = 0;
  if (address.is_ipv6()) {
    sockaddr_in6 in{};
    in.sin6_family = AF_INET6;
    in.sin6_port = htons(address.port);
    understood = inet_pton(AF_INET6, address.host.c_str(), &in.sin6_addr);
    end.size = sizeof in;
    std::memcpy(&end.storage, &in, sizeof in);
  } else {
    sockaddr_in in{};
    in.sin_family = AF_INET;
    in.sin_port = htons(address.port);
    understood = inet_pton(AF_INET, address.host.c_str(), &in.sin_addr);
    end.size = sizeof in;
    std::memcpy(&end.storage, &in, sizeof in);
  }
  if (understood != 1) throw std::invalid_argument(to_string(address) + ": not an address");
  return end;
}

Address address_of(const Endpoint& end) {
  std::array<char, INET6_ADDRSTRLEN> host{};
  if (end.storage.ss_family == AF_INET6) {
    sockaddr_in6 in{};
    std::memcpy(&in, &end.storage, sizeof in);
    inet_ntop(AF_INET6, &in.sin6_addr, host.data(), host.size());
    return {host.data(), ntohs(in.sin6_port)};
  }
  sockaddr_in in{};
  std::memcpy(&in, &end.storage, sizeof in);
  inet_ntop(AF_INET, &in.sin_addr, host.data(), host.size());
  return {host.data(), ntohs(in.sin_port)};
}

/// Throws with the reason that errno holds.
[[noreturn]] void fail(const Address& address, const char* what) {
  const int reason = errno;
  throw std::runtime_error(to_string(address) + ": " + what + ": " +
                           std::system_category().message(reason));
}

int open_socket(const Address& address) {
  const int family = address.is_ipv6() ? AF_INET6 : AF_INET;
  const int descriptor = ::socket(family, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) fail(address, "cannot open a socket");
  return descriptor;
}

Address local_address(int descriptor) {
  Endpoint end;
  if (::getsockname(descriptor, end.get(), &end.size) != 0) return {};
  return address_of(end);
}

timespec waiting_time(double seconds) {
  const double wait_s = seconds > 0 ? std::min(seconds, kLongestWait_s) : 0;  // NaN: 0
  const auto whole = static_cast<time_t>(wait_s);
  return {whole, static_cast<long>((wait_s - double(whole)) * 1e9)};
}

/// Once more after a signal, and once more after the refusal of an earlier datagram, which the
/// kernel reports in place of sending this one.
template <class Send>
Sent sent_by(const Send& send) {
  bool refused = false;
  for (;;) {
    if (send() >= 0) return refused ? Sent::AfterRefusal : Sent::Yes;
    if (errno == EINTR) continue;
    if (errno != ECONNREFUSED || refused) return Sent::No;
    refused = true;
  }
}

}  // namespace

UdpSocket::UdpSocket(int descriptor) : descriptor_(descriptor), buffer_(kMaxDatagram) {}

UdpSocket::UdpSocket(UdpSocket&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      local_(std::move(other.local_)),
      buffer_(std::move(other.buffer_)) {}

UdpSocket& UdpSocket::operator=(UdpSocket&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(local_, other.local_);
  std::swap(buffer_, other.buffer_);
  return *this;
}

UdpSocket::~UdpSocket() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

UdpSocket UdpSocket::bound_to(const Address& address) {
  const Endpoint end = endpoint(address);
  UdpSocket socket(open_socket(address));
  const int only = 1;  // "::" hears IPv6 alone on every machine, whatever its default
  if (address.is_ipv6()) {
    ::setsockopt(socket.descriptor_, IPPROTO_IPV6, IPV6_V6ONLY, &only, sizeof only);
  }
  if (::bind(socket.descriptor_, end.get(), end.size) != 0) fail(address, "cannot listen");
  socket.local_ = local_address(socket.descriptor_);
  return socket;
}

UdpSocket UdpSocket::connected_to(const Address& address) {
  if (address.port == 0 || address.is_any()) {
    throw std::invalid_argument(to_string(address) +
                                ": nothing can be sent there; give the receiver's host and port");
  }
  const Endpoint end = endpoint(address);
  UdpSocket socket(open_socket(address));
  if (::connect(socket.descriptor_, end.get(), end.size) != 0) fail(address, "cannot send there");
  socket.local_ = local_address(socket.descriptor_);
  return socket;
}

Sent UdpSocket::send(Bytes datagram) noexcept {
  return sent_by([&] {
    return ::send(descriptor_, datagram.data, datagram.size, MSG_DONTWAIT | MSG_NOSIGNAL);
  });
}

std::optional<Datagram> UdpSocket::receive(double timeout_s) {
  pollfd wanted{descriptor_, POLLIN, 0};
  const timespec wait = waiting_time(timeout_s);
  const int ready = ::ppoll(&wanted, 1, &wait, nullptr);
  if (ready == 0) return std::nullopt;
  Endpoint from;
  const ssize_t size = ready < 0 ? -1
                                 : ::recvfrom(descriptor_, buffer_.data(), buffer_.size(),
                                              MSG_DONTWAIT, from.get(), &from.size);
  if (size >= 0) return Datagram{{buffer_.data(), std::size_t(size)}, address_of(from)};
  switch (errno) {
    case EINTR:
    case EAGAIN:        // a checksum was wrong
    case ECONNREFUSED:  // an earlier datagram of ours was
      return std::nullopt;
    default:
      throw std::system_error(errno, std::system_category(), to_string(local_));
  }
}

}  // namespace kestrel

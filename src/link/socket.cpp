#include "kestrel/link/socket.hpp"

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "socket_address.hpp"

namespace kestrel {
namespace {

constexpr std::size_t kMaxDatagram = 65536;  // no UDP datagram is larger
constexpr double kLongestWait_s = 1e6;

std::optional<SocketAddress> spelled(const Address& address) noexcept {
  try {
    return socket_address(address);
  } catch (const std::exception&) {
    return std::nullopt;
  }
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
  const SocketAddress at = socket_address(address);
  UdpSocket socket(open_socket(address, SOCK_DGRAM));
  if (::bind(socket.descriptor_, at.get(), at.size) != 0) {
    fail_at(to_string(address), "cannot listen");
  }
  socket.local_ = local_address(socket.descriptor_);
  return socket;
}

UdpSocket UdpSocket::connected_to(const Address& address) {
  if (address.port == 0 || address.is_any()) {
    throw std::invalid_argument(to_string(address) +
                                ": nothing can be sent there; give the receiver's host and port");
  }
  const SocketAddress to = socket_address(address);
  UdpSocket socket(open_socket(address, SOCK_DGRAM));
  if (::connect(socket.descriptor_, to.get(), to.size) != 0) {
    fail_at(to_string(address), "cannot send there");
  }
  socket.local_ = local_address(socket.descriptor_);
  return socket;
}

Sent UdpSocket::send(Bytes datagram) noexcept {
  return sent_by([&] {
    return ::send(descriptor_, datagram.data, datagram.size, MSG_DONTWAIT | MSG_NOSIGNAL);
  });
}

Sent UdpSocket::send_to(const Address& address, Bytes datagram) noexcept {
  const std::optional<SocketAddress> to = spelled(address);
  if (!to) return Sent::No;
  return sent_by([&] {
    return ::sendto(descriptor_, datagram.data, datagram.size, MSG_DONTWAIT | MSG_NOSIGNAL,
                    to->get(), to->size);
  });
}

std::optional<Datagram> UdpSocket::take() noexcept {
  SocketAddress from;
  const ssize_t size =
      ::recvfrom(descriptor_, buffer_.data(), buffer_.size(), MSG_DONTWAIT, from.get(), &from.size);
  if (size < 0) return std::nullopt;
  return Datagram{{buffer_.data(), std::size_t(size)}, address_of(from)};
}

std::optional<Datagram> UdpSocket::receive(double timeout_s) {
  pollfd wanted{descriptor_, POLLIN, 0};
  const timespec wait = waiting_time(timeout_s);
  const int ready = ::ppoll(&wanted, 1, &wait, nullptr);
  if (ready == 0) return std::nullopt;
  if (ready > 0) {
    if (auto datagram = take()) return datagram;
  }
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

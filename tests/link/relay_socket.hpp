#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include "kestrel/link/address.hpp"
#include "kestrel/link/bytes.hpp"

// What the relays of the tests need of the system. Independent of the library's own sockets, so
// that a mistake there is not made twice.
namespace kestrel::test {

/// Closes what it holds.
class Descriptor {
 public:
  Descriptor() = default;
  /// Throws std::system_error, with what was tried, for a negative one.
  Descriptor(int descriptor, const char* what);
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor();

  int get() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

/// An address as the system wants it.
struct SystemAddress {
  sockaddr_storage storage{};
  socklen_t size = sizeof(sockaddr_storage);

  SystemAddress() = default;
  explicit SystemAddress(const Address& address);
  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
  Address address() const;
};

/// SOCK_DGRAM or SOCK_STREAM, not blocking, bound to the address; a stream listens.
Descriptor bound_socket(const Address& at, int type);

/// The same, connected (a stream's connection may still be under way).
Descriptor connected_socket(const Address& to, int type);

/// This end of a socket.
Address local_address(const Descriptor& socket);

/// What one read brings; empty bytes at the end of a stream, none when there is nothing yet or the
/// peer is gone (then `broken` says so).
struct ReadResult {
  std::optional<std::vector<std::uint8_t>> bytes;
  SystemAddress from;
  bool broken = false;
};
ReadResult read_some(const Descriptor& socket);

/// Seconds of the monotonic clock.
inline double monotonic_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Waits until one of them is ready, at most until the moment (at most a second).
void wait_ready(std::vector<pollfd>& sockets, double until_s);

}  // namespace kestrel::test

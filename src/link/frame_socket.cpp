#include "frame_socket.hpp"

#include <cerrno>
#include <cmath>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include "local_socket.hpp"
#include "socket_address.hpp"

namespace kestrel {
namespace {

// About two frames of 640x480: a reader that wakes from a pause finds no more than these are old.
constexpr int kBuffer_bytes = 1 << 19;

void set(int descriptor, int level, int option, int value) {
  ::setsockopt(descriptor, level, option, &value, sizeof value);
}

bool begins_to_connect(int descriptor, const FramePlace& to) {
  if (to.is_local()) return connect_locally(descriptor, to.path);
  const SocketAddress address = socket_address(to.address);
  return ::connect(descriptor, address.get(), address.size) == 0;
}

}  // namespace

void prepare_for_frames(int descriptor) {
  set(descriptor, SOL_SOCKET, SO_SNDBUF, kBuffer_bytes);
  // Of a local socket the kernel refuses these, and they are not needed.
  set(descriptor, IPPROTO_TCP, TCP_NODELAY, 1);
  set(descriptor, SOL_SOCKET, SO_KEEPALIVE, 1);
  set(descriptor, IPPROTO_TCP, TCP_KEEPIDLE, 3);
  set(descriptor, IPPROTO_TCP, TCP_KEEPINTVL, 1);
  set(descriptor, IPPROTO_TCP, TCP_KEEPCNT, 2);
}

OwnedDescriptor listen_for_frames(const FramePlace& at, int waiting) {
  if (at.is_local()) return OwnedDescriptor(listen_locally(at.path, waiting));
  const SocketAddress address = socket_address(at.address);
  OwnedDescriptor listener(open_socket(at.address, SOCK_STREAM | SOCK_NONBLOCK));
  set(listener.number(), SOL_SOCKET, SO_REUSEADDR, 1);  // else a restart waits for a minute
  if (::bind(listener.number(), address.get(), address.size) != 0 ||
      ::listen(listener.number(), waiting) != 0) {
    fail_at(to_string(at), "cannot listen");
  }
  return listener;
}

FramePlace place_of(int descriptor, const FramePlace& at) {
  return at.is_local() ? at : FramePlace{local_address(descriptor), {}};
}

OwnedDescriptor connect_for_frames(const FramePlace& to, double timeout_s) {
  OwnedDescriptor socket(to.is_local() ? local_socket(to.path, SOCK_NONBLOCK)
                                       : open_socket(to.address, SOCK_STREAM | SOCK_NONBLOCK));
  if (begins_to_connect(socket.number(), to)) return socket;
  if (errno != EINPROGRESS) fail_at(to_string(to), "nobody serves frames there");
  pollfd wanted{socket.number(), POLLOUT, 0};
  if (::poll(&wanted, 1, int(std::ceil(timeout_s * 1000))) <= 0) errno = ETIMEDOUT;
  int error = wanted.revents != 0 ? 0 : errno;
  socklen_t size = sizeof error;
  if (error == 0) ::getsockopt(socket.number(), SOL_SOCKET, SO_ERROR, &error, &size);
  // TCP lets a socket that finds nobody on this machine connect to itself.
  const bool itself = error == 0 && local_address(socket.number()) == to.address;
  errno = itself ? ECONNREFUSED : error;
  if (errno != 0) fail_at(to_string(to), "nobody serves frames there");
  return socket;
}

}  // namespace kestrel

#include "kestrel/link/stream_socket.hpp"

#include <cerrno>
#include <stdexcept>
#include <utility>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include "socket_address.hpp"

namespace kestrel {
namespace {

// Bytes that the kernel may keep unsent: more would be old commands that nobody can drop.
constexpr int kUnsentBytes = 1024;
constexpr int kBacklog = 16;

void set(int descriptor, int level, int option, int value) {
  ::setsockopt(descriptor, level, option, &value, sizeof value);
}

/// Small frames go at once; a peer that is gone is noticed within about silent_s.
void prepare(int descriptor, const StreamOptions& options) {
  const int silent_s = int(options.silent_s);
  set(descriptor, IPPROTO_TCP, TCP_NODELAY, 1);
  set(descriptor, SOL_SOCKET, SO_KEEPALIVE, 1);
  set(descriptor, IPPROTO_TCP, TCP_KEEPIDLE, silent_s > 2 ? silent_s - 2 : 1);
  set(descriptor, IPPROTO_TCP, TCP_KEEPINTVL, 1);
  set(descriptor, IPPROTO_TCP, TCP_KEEPCNT, 2);
  set(descriptor, IPPROTO_TCP, TCP_USER_TIMEOUT, int(options.silent_s * 1000));
  set(descriptor, IPPROTO_TCP, TCP_NOTSENT_LOWAT, kUnsentBytes);
}

bool would_wait() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

}  // namespace

void StreamOptions::check() const {
  if (queue_frames < 2) throw std::invalid_argument("queue_frames must be at least 2");
  if (!(silent_s >= 1 && silent_s <= 3600)) {
    throw std::invalid_argument("silent_s must be 1 to 3600");
  }
}

StreamSocket::StreamSocket(int descriptor, const Address& peer, const StreamOptions& options,
                           State state)
    : descriptor_(descriptor),
      peer_(peer),
      state_(state),
      queue_(options.queue_frames),
      buffer_(kChunk) {
  prepare(descriptor_, options);
}

StreamSocket::StreamSocket(StreamSocket&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      peer_(std::move(other.peer_)),
      state_(std::exchange(other.state_, State::Closed)),
      queue_(std::move(other.queue_)),
      buffer_(std::move(other.buffer_)) {}

StreamSocket& StreamSocket::operator=(StreamSocket&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(peer_, other.peer_);
  std::swap(state_, other.state_);
  std::swap(queue_, other.queue_);
  std::swap(buffer_, other.buffer_);
  return *this;
}

StreamSocket::~StreamSocket() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

StreamSocket StreamSocket::connecting_to(const Address& address, const StreamOptions& options) {
  options.check();
  const SocketAddress to = socket_address(address);
  StreamSocket socket(open_socket(address, SOCK_STREAM | SOCK_NONBLOCK), address, options,
                      State::Connecting);
  if (::connect(socket.descriptor_, to.get(), to.size) == 0) {
    socket.state_ = State::Open;
  } else if (errno != EINPROGRESS && errno != EINTR) {
    fail_at(to_string(address), "cannot connect");
  }
  return socket;
}

StreamSocket StreamSocket::of(int descriptor, const Address& from, const StreamOptions& options) {
  return {descriptor, from, options, State::Open};
}

StreamSocket::State StreamSocket::finish_connecting() noexcept {
  if (state_ != State::Connecting) return state_;
  int error = 0;
  socklen_t size = sizeof error;
  ::getsockopt(descriptor_, SOL_SOCKET, SO_ERROR, &error, &size);
  SocketAddress other;
  if (error == 0 && ::getpeername(descriptor_, other.get(), &other.size) != 0) return state_;
  // TCP lets a socket that finds nobody on this machine connect to itself.
  const bool itself = error == 0 && address_of(other) == local_address(descriptor_);
  state_ = error != 0 || itself ? State::Closed : State::Open;
  return state_;
}

std::size_t StreamSocket::write(Bytes bytes) noexcept {
  const ssize_t size = ::send(descriptor_, bytes.data, bytes.size, MSG_DONTWAIT | MSG_NOSIGNAL);
  if (size >= 0) return std::size_t(size);
  if (!would_wait()) state_ = State::Closed;
  return 0;
}

void StreamSocket::send(Bytes frame) noexcept {
  if (state_ != State::Open) return;
  flush();
  const std::size_t sent = queue_.empty() ? write(frame) : 0;
  if (sent < frame.size && state_ == State::Open) queue_.push(frame, sent);
}

void StreamSocket::flush() noexcept {
  while (state_ == State::Open && !queue_.empty()) {
    const std::size_t sent = write(queue_.next());
    if (sent == 0) return;
    queue_.sent(sent);
  }
}

Bytes StreamSocket::receive() noexcept {
  if (state_ != State::Open) return {};
  const ssize_t size = ::recv(descriptor_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
  if (size > 0) return {buffer_.data(), std::size_t(size)};
  if (size == 0 || !would_wait()) state_ = State::Closed;
  return {};
}

StreamListener::StreamListener(int descriptor) : descriptor_(descriptor) {}

StreamListener::StreamListener(StreamListener&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), local_(std::move(other.local_)) {}

StreamListener& StreamListener::operator=(StreamListener&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(local_, other.local_);
  return *this;
}

StreamListener::~StreamListener() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

StreamListener StreamListener::bound_to(const Address& address) {
  const SocketAddress at = socket_address(address);
  StreamListener listener(open_socket(address, SOCK_STREAM | SOCK_NONBLOCK));
  set(listener.descriptor_, SOL_SOCKET, SO_REUSEADDR, 1);  // else a restart waits for a minute
  if (::bind(listener.descriptor_, at.get(), at.size) != 0 ||
      ::listen(listener.descriptor_, kBacklog) != 0) {
    fail_at(to_string(address), "cannot listen");
  }
  listener.local_ = local_address(listener.descriptor_);
  return listener;
}

std::optional<StreamSocket> StreamListener::accept(const StreamOptions& options) noexcept {
  SocketAddress from;
  const int descriptor =
      ::accept4(descriptor_, from.get(), &from.size, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (descriptor < 0) return std::nullopt;
  return StreamSocket::of(descriptor, address_of(from), options);
}

}  // namespace kestrel

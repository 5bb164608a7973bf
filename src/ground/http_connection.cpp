#include "http_connection.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <string_view>

#include <fcntl.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <poll.h>

namespace kestrel {
namespace {

constexpr std::size_t kAhead = 4096;
/// What the kernel may keep of what a slow viewer has not been sent: less is younger (Linux
/// tcp(7)).
constexpr int kUnsent = 32 << 10;
constexpr unsigned char kTlsHandshake = 0x16;  // the first byte of a ClientHello (RFC 8446, 5.1)

std::chrono::steady_clock::duration seconds(double s) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(s));
}

void tell_place(int (*of)(int, sockaddr*, socklen_t*), socket_t socket, std::string& ip,
                int& port) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> service{};
  auto* as_any = reinterpret_cast<sockaddr*>(&address);
  if (of(socket, as_any, &size) != 0) return;
  if (::getnameinfo(as_any, size, host.data(), host.size(), service.data(), service.size(),
                    NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return;
  }
  ip = host.data();
  port = std::atoi(service.data());
}

}  // namespace

Connection::Connection(socket_t socket, const ConnectionLimits& limits, Tls tls)
    : socket_(socket),
      limits_(limits),
      tls_(std::move(tls)),
      deadline_(Clock::now() + seconds(limits.request_s)) {
  ::fcntl(socket_, F_SETFL, ::fcntl(socket_, F_GETFL) | O_NONBLOCK);
  ::setsockopt(socket_, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &kUnsent, sizeof kUnsent);
  if (tls_) SSL_set_fd(tls_.get(), socket_);
}

/// Until the socket can be read or written; false when the time is over.
bool Connection::waits_for(short events) {
  const auto until = std::min(deadline_, Clock::now() + seconds(limits_.silence_s));
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
    pollfd one{socket_, events, 0};
    const int ready = left > 0 ? ::poll(&one, 1, int(left)) : 0;
    if (ready > 0) return true;
    if (ready == 0) slow_ = true;
    if (ready == 0 || errno != EINTR) return false;
  }
}

/// What the last call wanted has come; false: it never will.
bool Connection::may_go_on(ssize_t result) {
  if (!tls_) return (errno == EAGAIN || errno == EINTR) && waits_for(answering_ ? POLLOUT : POLLIN);
  const int why = SSL_get_error(tls_.get(), int(result));
  if (why == SSL_ERROR_WANT_READ) return waits_for(POLLIN);
  return why == SSL_ERROR_WANT_WRITE && waits_for(POLLOUT);
}

bool Connection::greet() {
  if (!tls_) return true;
  if (!waits_for(POLLIN)) return false;
  unsigned char first = 0;
  const ssize_t peeked = ::recv(socket_, &first, 1, MSG_PEEK);
  if (peeked != 1) return false;
  heard_ = 1;
  if (first != kTlsHandshake) {
    constexpr std::string_view kWords =
        "HTTP/1.1 400 Bad Request\r\nContent-Type: text/plain\r\nConnection: close\r\n\r\n"
        "This port speaks TLS: write https:// before the address.\n";
    std::array<char, kAhead> request{};
    ::recv(socket_, request.data(), request.size(), 0);  // else the answer is lost with it
    ::send(socket_, kWords.data(), kWords.size(), MSG_NOSIGNAL);
    return false;
  }
  while (true) {
    ERR_clear_error();
    const int result = SSL_accept(tls_.get());
    if (result == 1) {
      heard_ = 0;  // of the request
      return true;
    }
    if (!may_go_on(result)) return false;
  }
}

void Connection::end() {
  ERR_clear_error();
  if (tls_ && SSL_is_init_finished(tls_.get()) == 1 && !slow_) SSL_shutdown(tls_.get());
}

bool Connection::is_writable() const {
  pollfd one{socket_, POLLIN, 0};
  if (::poll(&one, 1, 0) <= 0) return true;
  char byte = 0;
  return ::recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT) > 0;  // 0: the peer has gone
}

ssize_t Connection::receive(char* to, std::size_t size) {
  while (!slow_) {
    if (Clock::now() > deadline_) slow_ = true;  // one that always has a byte ready
    if (slow_) break;
    errno = 0;
    ERR_clear_error();
    const ssize_t result =
        tls_ ? SSL_read(tls_.get(), to, int(size)) : ::recv(socket_, to, size, 0);
    if (result > 0) return result;
    if (!tls_ && result == 0) return 0;
    if (!may_go_on(result)) break;
  }
  return -1;
}

ssize_t Connection::read(char* to, std::size_t size) {
  if (ahead_at_ == ahead_.size()) {
    if (heard_ > limits_.request_bytes) huge_ = true;
    if (huge_) return -1;
    ahead_.resize(kAhead);
    ahead_at_ = 0;
    const ssize_t got = receive(ahead_.data(), ahead_.size());
    ahead_.resize(got > 0 ? std::size_t(got) : 0);
    if (got <= 0) return got;
    heard_ += std::size_t(got);
  }
  const std::size_t count = std::min(size, ahead_.size() - ahead_at_);
  std::copy_n(ahead_.begin() + std::ptrdiff_t(ahead_at_), count, to);
  ahead_at_ += count;
  return ssize_t(count);
}

ssize_t Connection::write(const char* from, std::size_t size) {
  if (slow_) return -1;
  if (!answering_) {
    answering_ = true;
    deadline_ = trusted_ ? Clock::time_point::max() : Clock::now() + seconds(limits_.answer_s);
  }
  while (true) {
    errno = 0;
    ERR_clear_error();
    const auto most = std::min(size, std::size_t(std::numeric_limits<int>::max()));
    const ssize_t result =
        tls_ ? SSL_write(tls_.get(), from, int(most)) : ::send(socket_, from, most, MSG_NOSIGNAL);
    if (result > 0 || size == 0) return result;
    if (!may_go_on(result)) return -1;
  }
}

void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
  tell_place(::getpeername, socket_, ip, port);
}

void Connection::get_local_ip_and_port(std::string& ip, int& port) const {
  tell_place(::getsockname, socket_, ip, port);
}

}  // namespace kestrel

#include "link/tcp_relay.hpp"

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include <netinet/tcp.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace kestrel::test {
namespace {

constexpr std::size_t kMaxWaiting_bytes = 65536;

/// No waiting for more to send at once (Nagle): the line is the model's, not the kernel's.
void send_at_once(const Descriptor& socket) {
  const int yes = 1;
  setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

/// Closing resets, and tells so at once.
void reset_on_close(const Descriptor& socket) {
  const linger now{1, 0};
  setsockopt(socket.get(), SOL_SOCKET, SO_LINGER, &now, sizeof now);
}

}  // namespace

TcpRelay::Connection::Connection(Descriptor from, const RelayOptions& options, long number)
    : client(std::move(from)),
      upstream(connected_socket(options.to, SOCK_STREAM)),
      out(options.out, options.name + " out " + std::to_string(number)),
      back(options.back, options.name + " back " + std::to_string(number)) {
  send_at_once(client);
  send_at_once(upstream);
}

TcpRelay::TcpRelay(const RelayOptions& options)
    : options_(options),
      socket_(bound_socket(options.listen, SOCK_STREAM)),
      local_(local_address(socket_)),
      wake_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC), "eventfd") {
  options_.out.check(Carriage::Stream);
  options_.back.check(Carriage::Stream);
  thread_ = std::thread([this] { run(); });
}

TcpRelay::~TcpRelay() {
  done_ = true;
  eventfd_write(wake_.get(), 1);
  thread_.join();
}

RelayCounts TcpRelay::counts() const {
  const std::lock_guard lock(mutex_);
  RelayCounts sum = past_;
  for (const Connection& c : connections_) {
    sum.out = sum.out + c.out.line.counts();
    sum.back = sum.back + c.back.line.counts();
  }
  sum.conversations += long(connections_.size());
  return sum;
}

void TcpRelay::run() {
  while (!done_) {
    std::vector<pollfd> sockets = interests();
    wait_ready(sockets, next_s());
    const std::lock_guard lock(mutex_);
    accept_all();
    const bool cut = cut_.exchange(false);
    for (Connection& c : connections_) {
      turn(c, monotonic_s());
      if (!cut) continue;
      reset_on_close(c.client);
      reset_on_close(c.upstream);
      c.broken = true;
    }
    end_all_that_are_broken();
  }
}

void TcpRelay::accept_all() {
  for (;;) {
    const int accepted = accept4(socket_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (accepted < 0) return;
    const long number = past_.conversations + long(connections_.size());
    try {
      connections_.emplace_back(Descriptor(accepted, "accept"), options_, number);
    } catch (const std::system_error&) {
      // nobody there: the one who came is told by the closing of its connection
    }
  }
}

void TcpRelay::turn(Connection& c, double now_s) {
  carry(c.out, c.client, c.upstream, c, now_s);
  carry(c.back, c.upstream, c.client, c, now_s);
  if (c.out.told_the_end && c.back.told_the_end) c.broken = true;
}

void TcpRelay::carry(Half& half, const Descriptor& from, const Descriptor& to, Connection& c,
                     double now_s) {
  if (!half.source_ended &&
      half.line.under_way_bytes() + half.outbound.size() < kMaxWaiting_bytes) {
    const ReadResult got = read_some(from);
    if (got.broken && errno != ENOTCONN) c.broken = true;
    if (got.bytes && got.bytes->empty()) half.source_ended = true;
    if (got.bytes && !got.bytes->empty() && !blocked_) {
      half.line.send({got.bytes->data(), got.bytes->size()}, now_s);
    } else if (got.bytes && !got.bytes->empty()) {
      ++past_.blocked;
    }
  }
  for (const auto& piece : half.line.arrived(now_s)) {
    half.outbound.insert(half.outbound.end(), piece.begin(), piece.end());
  }
  if (!half.outbound.empty()) {
    const ssize_t sent = send(to.get(), half.outbound.data(), half.outbound.size(), MSG_NOSIGNAL);
    if (sent > 0) half.outbound.erase(half.outbound.begin(), half.outbound.begin() + sent);
    if (sent < 0 && errno != EAGAIN && errno != EINTR && errno != ENOTCONN) c.broken = true;
  }
  const bool all_told = half.outbound.empty() && half.line.under_way_bytes() == 0;
  if (half.source_ended && all_told && !half.told_the_end && !blocked_) {
    shutdown(to.get(), SHUT_WR);
    half.told_the_end = true;
  }
}

void TcpRelay::end_all_that_are_broken() {
  for (auto c = connections_.begin(); c != connections_.end();) {
    if (!c->broken) {
      ++c;
      continue;
    }
    past_.out = past_.out + c->out.line.counts();
    past_.back = past_.back + c->back.line.counts();
    ++past_.conversations;
    c = connections_.erase(c);
  }
}

double TcpRelay::next_s() const {
  double next = monotonic_s() + (cut_ || blocked_ ? 0.01 : 0.1);  // to see what others ask for
  for (const Connection& c : connections_) {
    next = std::min({next, c.out.line.next_arrival_s(), c.back.line.next_arrival_s()});
  }
  return next;
}

std::vector<pollfd> TcpRelay::interests() const {
  std::vector<pollfd> sockets = {{socket_.get(), POLLIN, 0}, {wake_.get(), POLLIN, 0}};
  const auto wanted = [](const Half& reads, const Half& writes) {
    const bool room = reads.line.under_way_bytes() + reads.outbound.size() < kMaxWaiting_bytes;
    const int in = room && !reads.source_ended ? POLLIN : 0;
    return short(in | (writes.outbound.empty() ? 0 : POLLOUT));
  };
  // poll passes over negative descriptors; it would tell of a reset without being asked, for ever.
  const auto add = [&sockets](const Descriptor& socket, short events) {
    sockets.push_back({events == 0 ? -1 : socket.get(), events, 0});
  };
  for (const Connection& c : connections_) {
    add(c.client, wanted(c.out, c.back));
    add(c.upstream, wanted(c.back, c.out));
  }
  return sockets;
}

}  // namespace kestrel::test

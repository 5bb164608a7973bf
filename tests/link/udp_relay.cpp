#include "link/udp_relay.hpp"

#include <algorithm>
#include <cstring>
#include <string>

#include <sys/eventfd.h>
#include <unistd.h>

namespace kestrel::test {
namespace {

constexpr std::size_t kMaxConversations = 64;

bool same(const SystemAddress& a, const SystemAddress& b) {
  return a.size == b.size && std::memcmp(&a.storage, &b.storage, a.size) == 0;
}

}  // namespace

UdpRelay::Conversation::Conversation(const SystemAddress& from, const RelayOptions& options,
                                     int number)
    : client(from),
      upstream(connected_socket(options.to, SOCK_DGRAM)),
      out(options.out, Carriage::Datagrams, options.name + " out " + std::to_string(number)),
      back(options.back, Carriage::Datagrams, options.name + " back " + std::to_string(number)) {}

UdpRelay::UdpRelay(const RelayOptions& options)
    : options_(options),
      socket_(bound_socket(options.listen, SOCK_DGRAM)),
      local_(local_address(socket_)),
      wake_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC), "eventfd") {
  options_.out.check(Carriage::Datagrams);
  options_.back.check(Carriage::Datagrams);
  thread_ = std::thread([this] { run(); });
}

UdpRelay::~UdpRelay() {
  done_ = true;
  eventfd_write(wake_.get(), 1);
  thread_.join();
}

RelayCounts UdpRelay::counts() const {
  const std::lock_guard lock(mutex_);
  RelayCounts sum;
  for (const Conversation& c : conversations_) {
    sum.out = sum.out + c.out.counts();
    sum.back = sum.back + c.back.counts();
  }
  sum.conversations = long(conversations_.size());
  sum.blocked = thrown_away_;
  return sum;
}

void UdpRelay::run() {
  while (!done_) {
    std::vector<pollfd> sockets = {{socket_.get(), POLLIN, 0}, {wake_.get(), POLLIN, 0}};
    for (const Conversation& c : conversations_) sockets.push_back({c.upstream.get(), POLLIN, 0});
    wait_ready(sockets, next_s());
    const std::lock_guard lock(mutex_);
    take_from_clients(monotonic_s());
    take_from_upstream(monotonic_s());
    deliver(monotonic_s());
  }
}

void UdpRelay::take_from_clients(double now_s) {
  for (ReadResult got = read_some(socket_); got.bytes; got = read_some(socket_)) {
    Conversation* c = conversation(got.from);
    if (c == nullptr || blocked_) {
      ++thrown_away_;
    } else {
      c->out.send({got.bytes->data(), got.bytes->size()}, now_s);
    }
  }
}

void UdpRelay::take_from_upstream(double now_s) {
  for (Conversation& c : conversations_) {
    for (ReadResult got = read_some(c.upstream); got.bytes; got = read_some(c.upstream)) {
      if (blocked_) {
        ++thrown_away_;
      } else {
        c.back.send({got.bytes->data(), got.bytes->size()}, now_s);
      }
    }
  }
}

void UdpRelay::deliver(double now_s) {
  for (Conversation& c : conversations_) {
    // A refusal by the other end is a datagram lost, as on any line.
    for (const auto& piece : c.out.arrived(now_s)) {
      send(c.upstream.get(), piece.data(), piece.size(), MSG_NOSIGNAL);
    }
    for (const auto& piece : c.back.arrived(now_s)) {
      sendto(socket_.get(), piece.data(), piece.size(), MSG_NOSIGNAL, c.client.get(),
             c.client.size);
    }
  }
}

double UdpRelay::next_s() const {
  double next = monotonic_s() + 1;
  for (const Conversation& c : conversations_) {
    next = std::min({next, c.out.next_arrival_s(), c.back.next_arrival_s()});
  }
  return next;
}

UdpRelay::Conversation* UdpRelay::conversation(const SystemAddress& from) {
  for (Conversation& c : conversations_) {
    if (same(c.client, from)) return &c;
  }
  if (conversations_.size() >= kMaxConversations) return nullptr;
  conversations_.emplace_back(from, options_, int(conversations_.size()));
  return &conversations_.back();
}

}  // namespace kestrel::test

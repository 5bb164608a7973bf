// The relays over which the tests of the link run: what they promise on a real loopback. Times have
// lower bounds only, but for the patience of a test that fails.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "link/loopback.hpp"
#include "link/tcp_relay.hpp"
#include "link/udp_relay.hpp"

namespace kestrel::test {
namespace {

using Piece = std::vector<std::uint8_t>;

Bytes view(const Piece& piece) { return {piece.data(), piece.size()}; }
Piece copy(Bytes bytes) { return Piece(bytes.begin(), bytes.end()); }

RelayOptions towards(const Address& to) {
  RelayOptions options;
  options.listen = {to.host, 0};
  options.to = to;
  return options;
}

/// Waits for readiness of one socket.
bool ready(const Descriptor& socket, short events, double wait_s = kPatience_s) {
  std::vector<pollfd> one = {{socket.get(), events, 0}};
  const double end_s = monotonic_s() + wait_s;
  while (one[0].revents == 0 && monotonic_s() < end_s) wait_ready(one, end_s);
  return one[0].revents != 0;
}

TEST(UdpRelay, CarriesBothWaysAndTellsSendersApart) {
  for (const Address& loopback : loopbacks()) {
    UdpSocket far = UdpSocket::bound_to(loopback);
    const UdpRelay relay(towards(far.local()));
    UdpSocket one = UdpSocket::connected_to(relay.local());
    UdpSocket two = UdpSocket::connected_to(relay.local());
    one.send(view({1}));
    const auto first = far.receive(kPatience_s);
    ASSERT_TRUE(first);
    EXPECT_EQ(copy(first->bytes), Piece{1});
    two.send(view({2, 2}));
    const auto second = far.receive(kPatience_s);
    ASSERT_TRUE(second);
    EXPECT_EQ(copy(second->bytes), (Piece{2, 2}));
    EXPECT_NE(first->from, second->from);
    EXPECT_EQ(relay.counts().conversations, 2);
    EXPECT_EQ(relay.counts().out.delivered, 2);
  }
}

TEST(UdpRelay, BringsTheAnswerToTheOneWhoAsked) {
  const Descriptor far = bound_socket({"127.0.0.1", 0}, SOCK_DGRAM);
  const UdpRelay relay(towards(local_address(far)));
  UdpSocket one = UdpSocket::connected_to(relay.local());
  UdpSocket two = UdpSocket::connected_to(relay.local());
  for (UdpSocket* near : {&one, &two}) {
    near->send(view({1}));
    ASSERT_TRUE(ready(far, POLLIN));
    const ReadResult asked = read_some(far);
    sendto(far.get(), "answer", 6, 0, asked.from.get(), asked.from.size);
    const auto answer = near->receive(kPatience_s);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->bytes.size, 6u);
  }
  EXPECT_FALSE(one.receive(0.01));
}

/// Sends `count` numbered datagrams and returns what arrives, in its order.
std::vector<int> through(const RelayOptions& wanted, int count) {
  UdpSocket far = UdpSocket::bound_to({"127.0.0.1", 0});
  RelayOptions options = wanted;
  options.to = far.local();
  const UdpRelay relay(options);
  UdpSocket near = UdpSocket::connected_to(relay.local());
  std::vector<int> got;
  const auto take = [&](double wait_s) {
    for (auto next = far.receive(wait_s); next; next = far.receive(0)) {
      got.push_back(next->bytes.data[0] | next->bytes.data[1] << 8);
    }
  };
  const double end_s = monotonic_s() + kPatience_s;
  for (int i = 0; i < count; ++i) {
    near.send(view({std::uint8_t(i), std::uint8_t(i >> 8), 0, 0}));
    take(0);
    // A socket's buffer holds some 270 small datagrams.
    while (relay.counts().out.sent < i - 100 && monotonic_s() < end_s) take(0.001);
  }
  const auto all_through = [&] {
    const LineCounts out = relay.counts().out;
    return out.sent == count &&
           out.delivered == out.sent + out.duplicated - out.lost - out.overflowed &&
           long(got.size()) == out.delivered;
  };
  while (!all_through() && monotonic_s() < end_s) take(0.002);
  EXPECT_TRUE(all_through());
  return got;
}

TEST(UdpRelay, LosesDoublesAndReordersAsItsLineSays) {
  RelayOptions options;
  options.out.loss = 0.3;
  options.out.duplication = 0.2;
  options.out.jitter_s = 0.005;
  const std::vector<int> got = through(options, 500);
  const std::vector<int> again = through(options, 500);
  // Which are lost and doubled is the seed's alone; only the order is the clock's too.
  std::vector<int> sorted = got;
  std::vector<int> sorted_again = again;
  std::sort(sorted.begin(), sorted.end());
  std::sort(sorted_again.begin(), sorted_again.end());
  EXPECT_EQ(sorted, sorted_again);
  EXPECT_NEAR(double(got.size()), 500 * 0.9, 5 * 15);  // five standard deviations
  EXPECT_NE(got, sorted);
}

TEST(UdpRelay, NothingArrivesBeforeTheDelay) {
  UdpSocket far = UdpSocket::bound_to({"127.0.0.1", 0});
  RelayOptions options = towards(far.local());
  options.out.delay_s = 0.05;
  const UdpRelay relay(options);
  UdpSocket near = UdpSocket::connected_to(relay.local());
  const double sent_s = monotonic_s();
  near.send(view({1}));
  ASSERT_TRUE(far.receive(kPatience_s));
  EXPECT_GE(monotonic_s() - sent_s, 0.05);
}

TEST(UdpRelay, ABlockedLineCarriesNothing) {
  UdpSocket far = UdpSocket::bound_to({"127.0.0.1", 0});
  UdpRelay relay(towards(far.local()));
  UdpSocket near = UdpSocket::connected_to(relay.local());
  relay.block();
  near.send(view({1}));
  EXPECT_FALSE(far.receive(0.05));
  EXPECT_EQ(relay.counts().blocked, 1);
  relay.unblock();
  near.send(view({2}));
  const auto got = far.receive(kPatience_s);
  ASSERT_TRUE(got);
  EXPECT_EQ(copy(got->bytes), Piece{2});
}

/// A connection through a relay, both ends.
struct Line {
  explicit Line(const RelayOptions& wanted)
      : listener(bound_socket({"127.0.0.1", 0}, SOCK_STREAM)), relay(to_listener(wanted)) {
    near = connected_socket(relay.local(), SOCK_STREAM);
    if (!ready(listener, POLLIN)) return;
    far = Descriptor(accept4(listener.get(), nullptr, nullptr, SOCK_NONBLOCK), "accept");
    ready(near, POLLOUT);
  }

  RelayOptions to_listener(RelayOptions options) const {
    options.to = local_address(listener);
    return options;
  }

  Descriptor listener;
  TcpRelay relay;
  Descriptor near;
  Descriptor far;
};

/// Sends all and half closes, reads to the end: what arrived.
Piece carried(const Piece& sent, const Descriptor& from, const Descriptor& to) {
  Piece got;
  std::size_t done = 0;
  const double end_s = monotonic_s() + kPatience_s;
  while (monotonic_s() < end_s) {
    if (done < sent.size()) {
      const ssize_t count = send(from.get(), sent.data() + done,
                                 std::min<std::size_t>(1000, sent.size() - done), MSG_NOSIGNAL);
      if (count > 0) done += std::size_t(count);
      if (done == sent.size()) shutdown(from.get(), SHUT_WR);
    } else {
      ready(to, POLLIN);
    }
    const ReadResult read = read_some(to);
    if (read.broken || (read.bytes && read.bytes->empty())) break;
    if (read.bytes) got.insert(got.end(), read.bytes->begin(), read.bytes->end());
  }
  return got;
}

TEST(TcpRelay, CarriesEveryByteBothWays) {
  RelayOptions options;
  options.out.splitting = options.back.splitting = 0.5;
  options.out.loss = options.back.loss = 0.1;
  options.out.retransmission_s = options.back.retransmission_s = 0.002;
  Line line(options);
  Piece sent(300000);
  for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = std::uint8_t(i * 7 + i / 256);
  EXPECT_EQ(carried(sent, line.near, line.far), sent);
  EXPECT_EQ(carried(sent, line.far, line.near), sent);
}

TEST(TcpRelay, ACutIsAResetForBothEnds) {
  Line line({});
  EXPECT_EQ(line.relay.counts().conversations, 1);
  line.relay.cut();
  for (const Descriptor* end : {&line.near, &line.far}) {
    ASSERT_TRUE(ready(*end, POLLIN));
    EXPECT_TRUE(read_some(*end).broken);
  }
}

TEST(TcpRelay, ABlockedLineIsHalfOpenForBothEnds) {
  Line line({});
  line.relay.block();
  EXPECT_EQ(send(line.near.get(), "ab", 2, MSG_NOSIGNAL), 2);
  shutdown(line.near.get(), SHUT_WR);
  EXPECT_FALSE(ready(line.far, POLLIN, 0.1));
}

TEST(TcpRelay, AReaderThatDoesNotReadHoldsUpItsWriterOnly) {
  Line slow({});
  const Piece chunk(65536, 1);
  long taken = 0;
  const double end_s = monotonic_s() + 0.3;
  while (monotonic_s() < end_s) {
    const ssize_t count = send(slow.near.get(), chunk.data(), chunk.size(), MSG_NOSIGNAL);
    taken += std::max<ssize_t>(count, 0);
  }
  // Kernel buffers of four sockets (megabytes each at most) and the relay's own: not without end.
  EXPECT_LT(taken, 64L << 20);
  EXPECT_FALSE(ready(slow.near, POLLOUT, 0.05));
  const Descriptor other = connected_socket(slow.relay.local(), SOCK_STREAM);
  ASSERT_TRUE(ready(slow.listener, POLLIN));
  const Descriptor far(accept4(slow.listener.get(), nullptr, nullptr, SOCK_NONBLOCK), "accept");
  ASSERT_TRUE(ready(other, POLLOUT));
  EXPECT_EQ(carried({1, 2, 3}, other, far), (Piece{1, 2, 3}));
}

TEST(TcpRelay, NobodyBehindItClosesTheConnection) {
  RelayOptions options;
  options.to = local_address(bound_socket({"127.0.0.1", 0}, SOCK_STREAM));  // closed again
  const TcpRelay relay(options);
  const Descriptor near = connected_socket(relay.local(), SOCK_STREAM);
  ASSERT_TRUE(ready(near, POLLIN));
  const ReadResult read = read_some(near);
  EXPECT_TRUE(read.broken || (read.bytes && read.bytes->empty()));
}

}  // namespace
}  // namespace kestrel::test

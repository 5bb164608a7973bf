#include "kestrel/link/datagram_port.hpp"

#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "kestrel/link/frame.hpp"

#include "loopback.hpp"

namespace kestrel {
namespace {

const mavlink::EncodedFrame kFrame = mavlink::encode(mavlink::Heartbeat{}, {255, 190, 0});
const std::vector<std::uint8_t> kNoise = {1, 2, 3, 0xFD};

/// A server, and what it tells when something is there.
struct Server {
  Poller poller;
  DatagramPort port;

  explicit Server(const Address& at, const PortOptions& options = {})
      : port({LinkKind::UdpServer, at}, options, 5, poller) {}

  PortEvent next(double now_s) {
    EXPECT_FALSE(poller.wait(test::kPatience_s).empty());
    return port.next(0, now_s).value_or(PortEvent{});
  }
};

TEST(DatagramPort, EverySenderOfAFrameIsAPeerAndIsAnswered) {
  for (const Address& loopback : test::loopbacks()) {
    Server server(loopback);
    UdpSocket first = UdpSocket::connected_to(server.port.address());
    UdpSocket second = UdpSocket::connected_to(server.port.address());
    first.send(kFrame.bytes());
    const PortEvent came = server.next(0);
    EXPECT_TRUE(came.came);
    EXPECT_EQ(came.from, first.local());
    EXPECT_EQ(came.bytes.size, kFrame.size);
    EXPECT_EQ(port_of(came.peer), 5u);
    second.send(kFrame.bytes());
    const PortEvent other = server.next(0);
    EXPECT_TRUE(other.came);
    EXPECT_NE(other.peer, came.peer);
    first.send({kNoise.data(), kNoise.size()});  // of a peer: the core shall count it
    const PortEvent again = server.next(0);
    EXPECT_FALSE(again.came);
    EXPECT_EQ(again.peer, came.peer);
    EXPECT_EQ(again.bytes.size, kNoise.size());
    server.port.send(other.peer, kFrame.bytes());
    EXPECT_TRUE(second.receive(test::kPatience_s));
    EXPECT_FALSE(first.receive(0));
  }
}

TEST(DatagramPort, NoiseTakesNobodysPlace) {
  PortOptions options;
  options.max_peers = 2;
  Server server({"127.0.0.1", 0}, options);
  for (int i = 0; i < 10; ++i) {
    UdpSocket::connected_to(server.port.address()).send({kNoise.data(), kNoise.size()});
    EXPECT_EQ(server.next(0).peer, 0u);
  }
  EXPECT_EQ(server.port.counts().strangers, 10u);
  UdpSocket sender = UdpSocket::connected_to(server.port.address());
  sender.send(kFrame.bytes());
  EXPECT_TRUE(server.next(0).came);
}

TEST(DatagramPort, WhoIsSilentMakesRoomForWhoIsNot) {
  PortOptions options;
  options.max_peers = 1;
  Server server({"127.0.0.1", 0}, options);
  UdpSocket first = UdpSocket::connected_to(server.port.address());
  UdpSocket second = UdpSocket::connected_to(server.port.address());
  first.send(kFrame.bytes());
  const PeerId peer = server.next(10).peer;
  second.send(kFrame.bytes());
  EXPECT_EQ(server.next(10 + 0.9 * options.replace_s).peer, 0u);  // it may yet speak
  EXPECT_EQ(server.port.counts().turned_away, 1u);
  second.send(kFrame.bytes());
  const PortEvent gone = server.next(10 + 1.1 * options.replace_s);
  EXPECT_TRUE(gone.went);
  EXPECT_EQ(gone.peer, peer);
  second.send(kFrame.bytes());
  EXPECT_TRUE(server.next(10 + 1.2 * options.replace_s).came);
}

TEST(DatagramPort, WhoIsSilentForLongIsForgotten) {
  Server server({"127.0.0.1", 0});
  UdpSocket sender = UdpSocket::connected_to(server.port.address());
  sender.send(kFrame.bytes());
  const PeerId peer = server.next(10).peer;
  EXPECT_FALSE(server.port.due(10 + 0.9 * PortOptions{}.forget_s));
  const std::optional<PortEvent> gone = server.port.due(10 + 1.1 * PortOptions{}.forget_s);
  ASSERT_TRUE(gone);
  EXPECT_TRUE(gone->went);
  EXPECT_EQ(gone->peer, peer);
  EXPECT_FALSE(server.port.due(100));
}

TEST(DatagramPort, AClientHasItsPeerFromTheStartAndHearsNobodyElse) {
  Poller poller;
  UdpSocket other = UdpSocket::bound_to({"127.0.0.1", 0});
  DatagramPort port({LinkKind::UdpClient, other.local()}, {}, 0, poller);
  const std::optional<PortEvent> came = port.due(0);
  ASSERT_TRUE(came);
  EXPECT_TRUE(came->came);
  EXPECT_FALSE(port.due(1000));
  port.send(came->peer, kFrame.bytes());
  const std::optional<Datagram> datagram = other.receive(test::kPatience_s);
  ASSERT_TRUE(datagram);
  const Address client = datagram->from;
  UdpSocket::connected_to(client).send(kFrame.bytes());  // an intruder
  EXPECT_TRUE(poller.wait(0.01).empty());
  other.send_to(client, kFrame.bytes());
  EXPECT_FALSE(poller.wait(test::kPatience_s).empty());
  const std::optional<PortEvent> heard = port.next(0, 1);
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->peer, came->peer);
  EXPECT_FALSE(heard->came);
}

TEST(DatagramPort, CountsWhatTheNetworkDoesNotTake) {
  Poller poller;
  const Address nobody = test::deaf_port();
  DatagramPort port({LinkKind::UdpClient, nobody}, {}, 0, poller);
  const PeerId peer = port.due(0)->peer;
  const std::vector<std::uint8_t> huge(70000);
  port.send(peer, {huge.data(), huge.size()});
  EXPECT_EQ(port.traffic(peer).dropped, 1u);
  EXPECT_EQ(port.counts().dropped, 1u);
  port.send(peer + 1, kFrame.bytes());  // nobody's: passed over
  EXPECT_EQ(port.counts().dropped, 1u);
}

}  // namespace
}  // namespace kestrel

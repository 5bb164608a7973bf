#include "kestrel/link/link_port.hpp"

#include <memory>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "kestrel/link/frame.hpp"

#include "loopback.hpp"

namespace kestrel {
namespace {

using Ports = std::vector<std::unique_ptr<LinkPort>>;

const mavlink::EncodedFrame kFrame = mavlink::encode(mavlink::Heartbeat{}, {255, 190, 0});

/// Turns both ports' wheels until one tells of bytes.
std::optional<PortEvent> bytes_from(Poller& poller, Ports& ports) {
  for (int i = 0; i < 1000; ++i) {
    for (const auto& port : ports) port->due(i * 0.01);
    for (const std::uint64_t tag : std::vector<std::uint64_t>(poller.wait(0.01))) {
      const auto event = ports[std::size_t(tag >> 32)]->next(tag, i * 0.01);
      if (event && event->bytes.size > 0) return event;
    }
  }
  return std::nullopt;
}

TEST(LinkPort, IsTheSameForEveryKind) {
  for (const auto& [server, client] : {std::pair(LinkKind::UdpServer, LinkKind::UdpClient),
                                       std::pair(LinkKind::TcpServer, LinkKind::TcpClient)}) {
    for (const Address& loopback : test::loopbacks()) {
      Poller poller;
      Ports ports;
      ports.push_back(open_link_port({server, loopback}, {}, 0, poller));
      ports.push_back(open_link_port({client, ports[0]->address()}, {}, 1, poller));
      EXPECT_EQ(ports[1]->address(), ports[0]->address());
      const PeerId first_of_client = PeerNumbers(1).next();
      std::optional<PortEvent> there;
      for (int i = 0; i < 10 && !there; ++i) {
        for (int turn = 0; turn < 10; ++turn) {  // a TCP client is open after a few
          ports[1]->due(i);
          for (const std::uint64_t tag : std::vector<std::uint64_t>(poller.wait(0))) {
            ports[std::size_t(tag >> 32)]->next(tag, i);
          }
        }
        ports[1]->send(first_of_client, kFrame.bytes());
        there = bytes_from(poller, ports);
      }
      ASSERT_TRUE(there);
      EXPECT_EQ(port_of(there->peer), 0u);
      ports[0]->send(there->peer, kFrame.bytes());
      const std::optional<PortEvent> back = bytes_from(poller, ports);
      ASSERT_TRUE(back);
      EXPECT_EQ(back->peer, first_of_client);
      EXPECT_EQ(ports[0]->traffic(there->peer).dropped, 0u);
      EXPECT_EQ(ports[0]->counts().dropped, 0u);
    }
  }
}

}  // namespace
}  // namespace kestrel

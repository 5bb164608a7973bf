#include "kestrel/link/stream_port.hpp"

#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "kestrel/link/frame.hpp"

#include "loopback.hpp"

namespace kestrel {
namespace {

const mavlink::EncodedFrame kFrame = mavlink::encode(mavlink::Heartbeat{}, {255, 190, 0});

/// A port, and the first event that it tells.
struct Watched {
  Poller poller;
  StreamPort port;

  explicit Watched(const LinkPlace& place, const PortOptions& options = {})
      : port(place, options, 3, poller) {}

  PortEvent next(double now_s) {
    for (int i = 0; i < 100; ++i) {
      const std::vector<std::uint64_t> ready = poller.wait(test::kPatience_s);
      if (ready.empty()) break;
      for (const std::uint64_t tag : ready) {
        if (const auto event = port.next(tag, now_s)) return *event;
      }
    }
    ADD_FAILURE() << "nothing came";
    return {};
  }
};

Watched server(const Address& at, const PortOptions& options = {}) {
  return Watched({LinkKind::TcpServer, at}, options);
}

/// A connection from outside, open.
StreamSocket client_of(const StreamPort& port) {
  StreamSocket socket = StreamSocket::connecting_to(port.address());
  while (socket.finish_connecting() == StreamSocket::State::Connecting) continue;
  return socket;
}

TEST(StreamPort, EveryConnectionIsAPeer) {
  for (const Address& loopback : test::loopbacks()) {
    Watched at({LinkKind::TcpServer, loopback});
    StreamSocket first = client_of(at.port);
    const PortEvent came = at.next(0);
    EXPECT_TRUE(came.came);
    EXPECT_EQ(port_of(came.peer), 3u);
    StreamSocket second = client_of(at.port);
    const PortEvent other = at.next(0);
    EXPECT_TRUE(other.came);
    first.send(kFrame.bytes());
    const PortEvent said = at.next(0);
    EXPECT_EQ(said.peer, came.peer);
    EXPECT_EQ(said.bytes.size, kFrame.size);
    at.port.send(other.peer, kFrame.bytes());
    while (second.receive().size == 0) ASSERT_EQ(second.state(), StreamSocket::State::Open);
    { const StreamSocket closed = std::move(second); }
    const PortEvent gone = at.next(0);
    EXPECT_TRUE(gone.went);
    EXPECT_EQ(gone.peer, other.peer);
  }
}

TEST(StreamPort, AClientConnectsAndAfterALossAgain) {
  std::optional<Watched> at(std::in_place, LinkPlace{LinkKind::TcpServer, {"127.0.0.1", 0}});
  Watched client({LinkKind::TcpClient, at->port.address()});
  EXPECT_FALSE(client.port.due(0));
  EXPECT_TRUE(client.next(0).came);
  const PeerId there = at->next(0).peer;
  at->port.send(there, kFrame.bytes());
  EXPECT_EQ(client.next(0).bytes.size, kFrame.size);

  const Address address = at->port.address();
  at.reset();
  EXPECT_TRUE(client.next(10).went);
  client.port.due(10);  // not at once
  EXPECT_EQ(client.port.counts().attempts, 1u);
  Watched back({LinkKind::TcpServer, address});
  client.port.due(10.2);
  EXPECT_EQ(client.port.counts().attempts, 2u);
  EXPECT_TRUE(client.next(10.2).came);
}

TEST(StreamPort, PausesBetweenAttemptsDoubleUpToTheLongest) {
  const Address nobody = StreamListener::bound_to({"127.0.0.1", 0}).local();
  Watched client({LinkKind::TcpClient, nobody});
  double now_s = 0;
  const double step_s = 0.01;
  std::uint64_t before = 0;
  std::vector<double> at;
  while (now_s < 20) {
    client.port.due(now_s);
    if (client.port.counts().attempts > before) {
      before = client.port.counts().attempts;
      at.push_back(now_s);
      EXPECT_EQ(client.next(now_s).peer, 0u);  // refused
    }
    now_s += step_s;
  }
  ASSERT_GE(at.size(), 8u);
  for (std::size_t i = 1; i < at.size(); ++i) {
    const double pause_s = std::min(0.1 * double(1 << (i - 1)), 3.0);
    EXPECT_NEAR(at[i] - at[i - 1], pause_s, 2 * step_s) << i;
  }
}

TEST(StreamPort, WhoIsTooManyIsTurnedAwayUnlessSomebodyIsSilent) {
  PortOptions options;
  options.max_peers = 1;
  Watched at = server({"127.0.0.1", 0}, options);
  const StreamSocket first = client_of(at.port);
  const PeerId peer = at.next(0).peer;
  StreamSocket second = client_of(at.port);
  EXPECT_EQ(at.next(0.5 * options.replace_s).peer, 0u);
  EXPECT_EQ(at.port.counts().turned_away, 1u);
  const StreamSocket third = client_of(at.port);
  const PortEvent gone = at.next(2 * options.replace_s);  // the half-open one
  EXPECT_TRUE(gone.went);
  EXPECT_EQ(gone.peer, peer);
  const StreamSocket fourth = client_of(at.port);
  EXPECT_TRUE(at.next(2 * options.replace_s).came);
}

TEST(StreamPort, WhatASlowPeerLeavesIsSentWhenItReads) {
  Watched at({LinkKind::TcpServer, {"127.0.0.1", 0}});
  StreamSocket slow = client_of(at.port);
  const PeerId peer = at.next(0).peer;
  for (int i = 0; i < 1000000 && at.port.traffic(peer).dropped == 0; ++i) {
    at.port.send(peer, kFrame.bytes());
  }
  const std::size_t waiting = at.port.traffic(peer).queued;
  EXPECT_EQ(waiting, PortOptions{}.stream.queue_frames);
  for (int i = 0; i < 1000000 && at.port.traffic(peer).queued > 0; ++i) {
    slow.receive();
    for (const std::uint64_t tag : std::vector<std::uint64_t>(at.poller.wait(0))) {
      at.port.next(tag, 0);
    }
  }
  EXPECT_EQ(at.port.traffic(peer).queued, 0u);
  while (slow.receive().size > 0) continue;
  for (const std::uint64_t tag : std::vector<std::uint64_t>(at.poller.wait(0))) {
    at.port.next(tag, 0);
  }
  EXPECT_TRUE(at.poller.wait(0.01).empty());  // else the loop would spin
}

}  // namespace
}  // namespace kestrel

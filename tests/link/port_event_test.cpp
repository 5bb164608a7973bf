#include "kestrel/link/port_event.hpp"

#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(PortEvent, NumbersTellThePortAndDoNotComeAgain) {
  for (const std::size_t port : {std::size_t(0), std::size_t(7), kMaxPorts - 1}) {
    PeerNumbers numbers(port);
    std::set<PeerId> seen;
    for (int i = 0; i < 1000; ++i) {
      const PeerId id = numbers.next();
      EXPECT_NE(id, 0u);
      EXPECT_EQ(port_of(id), port);
      EXPECT_TRUE(seen.insert(id).second);
    }
  }
}

TEST(PortEvent, NumbersStartAnewWithoutTheZero) {
  PeerNumbers numbers(0);
  for (std::uint32_t i = 0; i < kPeerMask; ++i) numbers.next();
  EXPECT_EQ(numbers.next(), 1u);
}

TEST(PortEvent, OptionsThatCannotBeAreRefused) {
  EXPECT_NO_THROW(PortOptions{}.check());
  const auto refused = [](auto set) {
    PortOptions options;
    set(options);
    EXPECT_THROW(options.check(), std::invalid_argument);
  };
  refused([](PortOptions& o) { o.max_peers = 0; });
  refused([](PortOptions& o) { o.max_peers = 65; });
  refused([](PortOptions& o) { o.forget_s = 0; });
  refused([](PortOptions& o) { o.replace_s = -1; });
  refused([](PortOptions& o) { o.retry_s = 0; });
  refused([](PortOptions& o) { o.longest_retry_s = 0.01; });
  refused([](PortOptions& o) { o.stream.queue_frames = 0; });
}

}  // namespace
}  // namespace kestrel

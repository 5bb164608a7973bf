#include "kestrel/link/poller.hpp"

#include <chrono>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/link/socket.hpp"

#include "loopback.hpp"

namespace kestrel {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::uint8_t kByte = 1;

TEST(Poller, TellsWhatIsReadyByRisingTagUntilItIsServed) {
  Poller poller;
  UdpSocket a = UdpSocket::bound_to({"127.0.0.1", 0});
  UdpSocket b = UdpSocket::bound_to({"127.0.0.1", 0});
  EXPECT_TRUE(poller.watch(a.descriptor(), 9));
  EXPECT_TRUE(poller.watch(b.descriptor(), 3));
  EXPECT_THAT(poller.wait(0), IsEmpty());
  UdpSocket::connected_to(a.local()).send({&kByte, 1});
  UdpSocket::connected_to(b.local()).send({&kByte, 1});
  EXPECT_THAT(poller.wait(test::kPatience_s), ElementsAre(3, 9));
  EXPECT_TRUE(b.take());
  EXPECT_THAT(poller.wait(test::kPatience_s), ElementsAre(9));
  poller.forget(a.descriptor());
  EXPECT_THAT(poller.wait(0), IsEmpty());
}

TEST(Poller, WaitsForRoomOnlyWhereAsked) {
  Poller poller;
  const UdpSocket socket = UdpSocket::bound_to({"127.0.0.1", 0});
  EXPECT_TRUE(poller.watch(socket.descriptor(), 1, Poller::Interest::ReadAndWrite));
  EXPECT_THAT(poller.wait(0), ElementsAre(1));
  EXPECT_TRUE(poller.watch(socket.descriptor(), 2));
  EXPECT_THAT(poller.wait(0), IsEmpty());
  EXPECT_FALSE(poller.watch(-1, 1));
}

TEST(Poller, NeverWaitsLessThanAsked) {
  Poller poller;
  const auto start = std::chrono::steady_clock::now();
  poller.wait(0.0105);  // less, and a loop would spin until its time has come
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
  EXPECT_GE(waited.count(), 0.0105);
}

}  // namespace
}  // namespace kestrel

#include "kestrel/link/socket.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <limits>
#include <thread>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <unistd.h>

#include "loopback.hpp"
#include "samples.hpp"

namespace kestrel {
namespace {

using test::kPatience_s;

TEST(Socket, DeliversDatagramsWholeAndInOrder) {
  for (const Address& loopback : test::loopbacks()) {
    UdpSocket receiver = UdpSocket::bound_to(loopback);
    UdpSocket sender = UdpSocket::connected_to(receiver.local());
    EXPECT_NE(receiver.local().port, 0);
    EXPECT_EQ(receiver.local().host, loopback.host);
    for (std::size_t size : {0u, 1u, 12u, 280u, 60000u}) {
      const test::Buffer sent(size, std::uint8_t(size));
      EXPECT_EQ(sender.send(test::view(sent)), Sent::Yes);
      const auto datagram = receiver.receive(kPatience_s);
      ASSERT_TRUE(datagram);
      EXPECT_EQ(test::copy(datagram->bytes), sent);
      EXPECT_EQ(datagram->from, sender.local());
    }
  }
}

TEST(Socket, IsEmptyWhenNothingComes) {
  UdpSocket receiver = UdpSocket::bound_to({"127.0.0.1", 0});
  for (const double wait_s : {0.0, 0.001, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(receiver.receive(wait_s));
  }
}

TEST(Socket, RefusalOfADatagramIsToldWithTheNextWhichIsStillSent) {
  const Address deaf = test::deaf_port();
  UdpSocket sender = UdpSocket::connected_to(deaf);
  const test::Buffer byte = {1};
  EXPECT_EQ(sender.send(test::view(byte)), Sent::Yes);  // the answer comes after
  EXPECT_EQ(sender.send(test::view(byte)), Sent::AfterRefusal);
  UdpSocket late = UdpSocket::bound_to(deaf);
  EXPECT_EQ(sender.send(test::view(byte)), Sent::AfterRefusal);
  EXPECT_TRUE(late.receive(kPatience_s));
  EXPECT_EQ(sender.send(test::view(byte)), Sent::Yes);
  EXPECT_TRUE(late.receive(kPatience_s));
}

TEST(Socket, RefusalIsNothingToReceive) {
  UdpSocket sender = UdpSocket::connected_to(test::deaf_port());
  const test::Buffer byte = {1};
  sender.send(test::view(byte));
  EXPECT_FALSE(sender.receive(0.01));
  EXPECT_FALSE(sender.receive(0.001));
}

TEST(Socket, DoesNotSendWhatIsTooLarge) {
  UdpSocket receiver = UdpSocket::bound_to({"127.0.0.1", 0});
  UdpSocket sender = UdpSocket::connected_to(receiver.local());
  EXPECT_EQ(sender.send(test::view(test::Buffer(70000))), Sent::No);
  EXPECT_FALSE(receiver.receive(0));
}

TEST(Socket, NeverWaitsToSend) {
  UdpSocket receiver = UdpSocket::bound_to({"127.0.0.1", 0});
  UdpSocket sender = UdpSocket::connected_to(receiver.local());
  const test::Buffer large(60000);
  // Far more than any buffer of the kernel holds, read by nobody: the test ends.
  for (int i = 0; i < 2000; ++i) sender.send(test::view(large));
  EXPECT_TRUE(receiver.receive(0));
}

TEST(Socket, SaysWhyItCannotListenOrSend) {
  const UdpSocket first = UdpSocket::bound_to({"127.0.0.1", 0});
  EXPECT_THAT([&] { UdpSocket::bound_to(first.local()); },
              testing::ThrowsMessage<std::runtime_error>(testing::AllOf(
                  testing::HasSubstr(to_string(first.local())), testing::HasSubstr("in use"))));
  // 192.0.2.0/24 is kept for documentation: no interface of ours has 192.0.2.254.
  EXPECT_THROW(UdpSocket::bound_to({"192.0.2.254", 0}), std::runtime_error);
  EXPECT_THROW(UdpSocket::connected_to({"255.255.255.255", 5}), std::runtime_error);
  for (const Address& nowhere :
       {Address{"127.0.0.1", 0}, Address{"0.0.0.0", 5}, Address{"::", 5}, Address{"name", 5}}) {
    EXPECT_THROW(UdpSocket::connected_to(nowhere), std::invalid_argument) << nowhere.host;
  }
}

TEST(Socket, AnyAddressOfIpv6LeavesIpv4Alone) {
  if (test::loopbacks().size() < 2) GTEST_SKIP() << "no IPv6 here";
  const UdpSocket six = UdpSocket::bound_to({"::", 0});
  UdpSocket four = UdpSocket::bound_to({"0.0.0.0", six.local().port});
  UdpSocket sender = UdpSocket::connected_to({"127.0.0.1", six.local().port});
  const test::Buffer byte = {1};
  sender.send(test::view(byte));
  EXPECT_TRUE(four.receive(kPatience_s));
}

TEST(Socket, ABoundOneAnswersManyAndTakesWhatIsThere) {
  for (const Address& loopback : test::loopbacks()) {
    UdpSocket server = UdpSocket::bound_to(loopback);
    EXPECT_FALSE(server.take());
    UdpSocket first = UdpSocket::connected_to(server.local());
    UdpSocket second = UdpSocket::connected_to(server.local());
    const test::Buffer byte = {7};
    EXPECT_EQ(server.send_to(first.local(), test::view(byte)), Sent::Yes);
    EXPECT_EQ(server.send_to(second.local(), test::view(byte)), Sent::Yes);
    for (UdpSocket* client : {&first, &second}) {
      const std::optional<Datagram> datagram = client->receive(kPatience_s);
      ASSERT_TRUE(datagram);
      EXPECT_EQ(datagram->from, server.local());
      EXPECT_FALSE(client->take());
    }
    EXPECT_EQ(server.send_to({"nowhere", 1}, test::view(byte)), Sent::No);
  }
}

std::ptrdiff_t open_descriptors() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"),
                       std::filesystem::directory_iterator());
}

TEST(Socket, OwnsItsDescriptor) {
  const auto before = open_descriptors();
  {
    UdpSocket a = UdpSocket::bound_to({"127.0.0.1", 0});
    const Address local = a.local();
    UdpSocket b = std::move(a);
    UdpSocket c = UdpSocket::bound_to({"127.0.0.1", 0});
    c = std::move(b);
    EXPECT_EQ(c.local(), local);
    UdpSocket sender = UdpSocket::connected_to(local);
    const test::Buffer byte = {1};
    sender.send(test::view(byte));
    EXPECT_TRUE(c.receive(kPatience_s));
    EXPECT_THROW(UdpSocket::bound_to(local), std::runtime_error);
  }
  EXPECT_EQ(open_descriptors(), before);
}

extern "C" void note_signal(int) {}

TEST(Socket, ASignalEndsTheWait) {
  struct sigaction action {};
  struct sigaction previous {};
  action.sa_handler = note_signal;  // without SA_RESTART
  ASSERT_EQ(sigaction(SIGUSR1, &action, &previous), 0);
  UdpSocket receiver = UdpSocket::bound_to({"127.0.0.1", 0});
  const pthread_t waiting = pthread_self();
  std::atomic<bool> done = false;
  std::thread signals([&] {
    while (!done) {  // until one falls into the wait
      pthread_kill(waiting, SIGUSR1);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  EXPECT_FALSE(receiver.receive(1e9));  // were it not to end, neither would the test
  done = true;
  signals.join();
  sigaction(SIGUSR1, &previous, nullptr);
}

}  // namespace
}  // namespace kestrel

#include "kestrel/link/command_receiver.hpp"

#include <atomic>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "kestrel/link/command_link.hpp"

#include "loopback.hpp"
#include "samples.hpp"

namespace kestrel {
namespace {

TEST(CommandReceiver, HearsEveryCommandOfALink) {
  for (const Address& loopback : test::loopbacks()) {
    CommandReceiver receiver(loopback);
    CommandLink link(receiver.local());
    for (int i = 0; i < 300; ++i) {
      link.send({i * 0.5, -i * 0.25, 1, 0.125}, i / 32.0);
      const auto commands = receiver.poll(test::kPatience_s);
      ASSERT_EQ(commands.size(), 1u);
      EXPECT_EQ(commands[0].command.forward_m_s, i * 0.5);
      EXPECT_EQ(commands[0].command.right_m_s, -i * 0.25);
      EXPECT_EQ(commands[0].command.down_m_s, 1);
      EXPECT_EQ(commands[0].command.yaw_rate_rad_s, 0.125);
      EXPECT_EQ(commands[0].time_boot_ms, time_boot_ms(i / 32.0));
    }
    receiver.poll(0);  // a heartbeat may be left
    const ReceiverCounts& counts = receiver.counts();
    EXPECT_EQ(counts.commands, 300);
    EXPECT_EQ(counts.heartbeats, link.counts().heartbeats);
    EXPECT_EQ(counts.datagrams, counts.commands + counts.heartbeats);
    EXPECT_EQ(counts.lost + counts.late + counts.duplicates + counts.malformed(), 0);
    EXPECT_EQ(link.failures(), 0);
  }
}

TEST(CommandReceiver, TakesAllThatIsThereAtOnce) {
  CommandReceiver receiver({"127.0.0.1", 0});
  CommandLink link(receiver.local());
  for (int i = 0; i < 20; ++i) link.send({double(i), 0, 0, 0}, 0);
  const auto commands = receiver.poll(test::kPatience_s);
  ASSERT_EQ(commands.size(), 20u);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(commands[std::size_t(i)].command.forward_m_s, i);
}

TEST(CommandReceiver, IsNotHeldByAFlood) {
  CommandReceiver receiver({"127.0.0.1", 0});
  std::atomic<bool> done = false;
  std::thread flood([&] {
    CommandLink link(receiver.local());
    while (!done) link.send({1, 0, 0, 0}, 0);
  });
  for (int i = 0; i < 20; ++i) EXPECT_LE(receiver.poll(test::kPatience_s).size(), 256u);
  done = true;
  flood.join();
}

TEST(CommandReceiver, SurvivesHalvesAndGarbage) {
  CommandReceiver receiver({"127.0.0.1", 0});
  UdpSocket sender = UdpSocket::connected_to(receiver.local());
  const test::Buffer frame =
      test::copy(mavlink::encode(velocity_setpoint({1, 0, 0, 0}, 0, {}), {1, 191, 0}).bytes());
  const Bytes whole = test::view(frame);
  sender.send(whole.first(30));
  sender.send(whole.after(30));
  sender.send({});
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(receiver.poll(i == 0 ? test::kPatience_s : 0).empty());
  EXPECT_EQ(receiver.counts().datagrams, 3);
  EXPECT_EQ(receiver.counts().malformed(), 3);
  sender.send(whole);
  EXPECT_EQ(receiver.poll(test::kPatience_s).size(), 1u);
}

TEST(CommandReceiver, IsEmptyWhenNobodySpeaksAndSaysWhenThePortIsTaken) {
  CommandReceiver receiver({"127.0.0.1", 0});
  EXPECT_TRUE(receiver.poll(0.01).empty());
  EXPECT_TRUE(receiver.poll(0).empty());
  EXPECT_THROW(CommandReceiver{receiver.local()}, std::runtime_error);
}

TEST(CommandReceiver, ALinkHeardLateIsHeardFromThenOn) {
  const Address place = test::deaf_port();
  CommandLink link(place);
  for (int i = 0; i < 10; ++i) link.send({1, 0, 0, 0}, i * 0.1);
  CommandReceiver receiver(place);
  const long before = link.failures();
  for (int i = 10; i < 30; ++i) {
    link.send({double(i), 0, 0, 0}, i * 0.1);
    const auto commands = receiver.poll(test::kPatience_s);
    ASSERT_EQ(commands.size(), 1u);
    EXPECT_EQ(commands[0].command.forward_m_s, i);
  }
  EXPECT_LE(link.failures() - before, 1);  // the refusal that was still to come
  EXPECT_EQ(receiver.counts().lost, 0);
}

}  // namespace
}  // namespace kestrel

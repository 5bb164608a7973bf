#include "kestrel/ground/command_gate.hpp"

#include <atomic>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

struct Written final : CommandSink {
  std::vector<std::pair<VelocityCommand, double>> all;
  void send(const VelocityCommand& command, double stamp_s) noexcept override {
    all.emplace_back(command, stamp_s);
  }
  long failures() const override { return 3; }
};

const VelocityCommand kForward{0.5, 0, 0, 0.1};

TEST(CommandGate, IsClosedUntilItIsOpened) {
  Written written;
  CommandGate gate(written);
  EXPECT_FALSE(gate.is_open());
  gate.send(kForward, 1);
  gate.open();
  gate.send(kForward, 2);
  ASSERT_EQ(written.all.size(), 2u);
  EXPECT_TRUE(written.all[0].first.vector().isZero(0));
  EXPECT_EQ(written.all[0].second, 1);
  EXPECT_EQ(written.all[1].first.vector(), kForward.vector());
  EXPECT_EQ(gate.failures(), 3);
}

TEST(CommandGate, ClosingSendsZeroAtOnceAndItStaysSo) {
  Written written;
  CommandGate gate(written);
  gate.open();
  gate.send(kForward, 4);
  gate.close();
  ASSERT_EQ(written.all.size(), 2u) << "without waiting for the next frame";
  EXPECT_TRUE(written.all[1].first.vector().isZero(0));
  EXPECT_EQ(written.all[1].second, 4);
  gate.send(kForward, 5);
  EXPECT_TRUE(written.all[2].first.vector().isZero(0));
}

TEST(CommandGate, CountsWhatWentThrough) {
  Written written;
  CommandGate gate(written);
  gate.send(kForward, 1);  // closed: a zero
  gate.open();
  gate.send(kForward, 2);
  gate.close();
  EXPECT_EQ(gate.counts().commands, 3);
  EXPECT_EQ(gate.counts().zeros, 2);
}

TEST(CommandGate, AHandHasAWayOfItsOwnBesideTheLaw) {
  Written law;
  Written hand;
  CommandGate gate(law, &hand);
  const VelocityCommand right{0, 0.2, 0, 0};
  gate.fork(right);
  gate.send(kForward, 1);
  EXPECT_TRUE(law.all.back().first.vector().isZero(0)) << "closed";
  EXPECT_TRUE(hand.all.empty());
  gate.open();
  gate.fork(right);
  gate.send(kForward, 2);
  EXPECT_EQ(law.all.back().first.vector(), right.vector());
  ASSERT_EQ(hand.all.size(), 1u);
  EXPECT_EQ(hand.all.back().first.vector(), kForward.vector());
  gate.send(kForward, 3);
  EXPECT_EQ(hand.all.size(), 1u) << "for one command only";
  EXPECT_EQ(law.all.back().first.vector(), kForward.vector());
  EXPECT_EQ(gate.failures(), 6) << "of both ways";
}

TEST(CommandGate, ClosingForgetsTheHand) {
  Written law;
  Written hand;
  CommandGate gate(law, &hand);
  gate.open();
  gate.fork(kForward);
  gate.close();
  gate.open();
  gate.send(kForward, 1);
  EXPECT_TRUE(hand.all.empty()) << "it was decided before the stop";
}

TEST(CommandGate, NothingIsSentBeforeTheFirstFrame) {
  Written written;
  CommandGate gate(written);
  gate.close();
  EXPECT_TRUE(written.all.empty());
}

TEST(CommandGate, AfterItIsClosedByAnotherThreadNothingElsePasses) {
  Written written;
  CommandGate gate(written);
  gate.open();
  std::atomic<bool> closed{false};
  std::thread other([&] {
    gate.close();
    closed = true;
  });
  for (int i = 0; i < 1000 || !closed; ++i) gate.send(kForward, i);
  other.join();
  const std::size_t before = written.all.size();
  gate.send(kForward, 0);
  bool has_zero = false;
  for (std::size_t i = 0; i < before; ++i) {
    const bool zero = written.all[i].first.vector().isZero(0);
    EXPECT_FALSE(has_zero && !zero) << i;
    has_zero = has_zero || zero;
  }
  EXPECT_TRUE(written.all.back().first.vector().isZero(0));
}

}  // namespace
}  // namespace kestrel

#include "kestrel/link/send_queue.hpp"

#include <deque>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

using Frame = std::vector<std::uint8_t>;

Bytes view(const Frame& frame) { return {frame.data(), frame.size()}; }

/// The number in every byte of a frame, which tells the frames apart.
Frame frame(int number, std::size_t size = 20) { return Frame(size, std::uint8_t(number)); }

/// Sends one whole frame; its number, or -1.
int take(SendQueue& queue) {
  const Bytes next = queue.next();
  if (next.size == 0) return -1;
  const int number = next.data[0];
  queue.sent(next.size);
  return number;
}

TEST(SendQueue, GivesFramesInTheirOrder) {
  SendQueue queue(4);
  EXPECT_EQ(take(queue), -1);
  for (int round = 0; round < 3; ++round) {  // over the end of the ring
    for (int i = 0; i < 3; ++i) queue.push(view(frame(i)));
    for (int i = 0; i < 3; ++i) EXPECT_EQ(take(queue), i);
    EXPECT_TRUE(queue.empty());
  }
  EXPECT_EQ(queue.dropped(), 0);
}

TEST(SendQueue, TheOldestMakesRoom) {
  SendQueue queue(3);
  for (int i = 0; i < 10; ++i) queue.push(view(frame(i)));
  EXPECT_EQ(queue.size(), 3u);
  EXPECT_EQ(queue.dropped(), 7);
  for (int i = 7; i < 10; ++i) EXPECT_EQ(take(queue), i);
}

TEST(SendQueue, AFrameHalfSentIsNeverDropped) {
  SendQueue queue(3);
  queue.push(view(frame(0)));
  queue.sent(5);
  for (int i = 1; i < 10; ++i) queue.push(view(frame(i)));
  EXPECT_EQ(queue.next().size, 15u);
  EXPECT_EQ(take(queue), 0);
  EXPECT_EQ(take(queue), 8);
  EXPECT_EQ(take(queue), 9);

  queue.push(view(frame(1)), 19);  // the socket took all but one byte
  EXPECT_EQ(queue.next().size, 1u);
  EXPECT_EQ(take(queue), 1);
}

TEST(SendQueue, WhatIsNoFrameIsDropped) {
  SendQueue queue(2);
  queue.push({});
  queue.push(view(frame(1, mavlink::kMaxFrame + 1)));
  EXPECT_TRUE(queue.empty());
  queue.push(view(frame(2, mavlink::kMaxFrame)));
  EXPECT_EQ(queue.size(), 1u);
  queue.clear();
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(queue.dropped(), 3);
  EXPECT_THROW(SendQueue(1), std::invalid_argument);
}

/// Whatever the order of pushes and partial writes, what goes out is whole frames in their order,
/// and every frame is sent, waits or is counted as dropped.
TEST(SendQueue, TheBytesThatGoOutAreWholeFrames) {
  test::Random random("send_queue");
  SendQueue queue(5);
  Frame wire;
  int pushed = 0;
  for (int step = 0; step < 20000; ++step) {
    if (random.integer(0, 1) == 0) {
      ++pushed;  // its size follows from its number, so that a reader can check it
      queue.push(view(frame(pushed % 251, 1 + std::size_t(pushed % 251))));
    } else {
      const Bytes next = queue.next();
      const Bytes part = next.first(std::size_t(random.integer(0, int(next.size))));
      wire.insert(wire.end(), part.begin(), part.end());
      queue.sent(part.size);
    }
  }
  const std::size_t unfinished = queue.next().size;
  wire.insert(wire.end(), queue.next().begin(), queue.next().end());
  queue.sent(unfinished);
  long whole = 0;
  for (std::size_t at = 0; at < wire.size();) {
    const std::size_t size = 1 + std::size_t(wire[at]);
    ASSERT_LE(at + size, wire.size());
    for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(wire[at + i], wire[at]) << at;
    at += size;
    ++whole;
  }
  EXPECT_EQ(whole + queue.dropped() + long(queue.size()), pushed);
  EXPECT_GT(queue.dropped(), 100);
  EXPECT_GT(whole, 1000);
}

}  // namespace
}  // namespace kestrel

#include "kestrel/link/time_messages.hpp"

#include <gtest/gtest.h>

#include "samples.hpp"

namespace kestrel::mavlink {
namespace {

using test::Buffer;

TEST(TimeMessages, PutFieldsWhereTheStandardDoes) {
  TimeSync sync;
  sync.tc1_ns = -1;
  sync.ts1_ns = 0x0102030405060708;
  const Buffer wire = test::fields(sync);
  EXPECT_EQ(wire[0], 0xFF);
  EXPECT_EQ(wire[7], 0xFF);
  EXPECT_EQ(wire[8], 0x08);
  EXPECT_EQ(wire[15], 0x01);
  Ping ping;
  ping.seq = 7;
  ping.target_component = 9;
  EXPECT_EQ(test::fields(ping)[8], 7);
  EXPECT_EQ(test::fields(ping)[13], 9);
}

}  // namespace
}  // namespace kestrel::mavlink

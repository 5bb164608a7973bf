#include "kestrel/link/command_messages.hpp"

#include <gtest/gtest.h>

#include "samples.hpp"

namespace kestrel::mavlink {
namespace {

using test::Buffer;

TEST(CommandMessages, PutFieldsWhereTheStandardDoes) {
  CommandLong command;
  command.command = 400;
  command.param1 = 1;
  command.target_system = 3;
  command.target_component = 4;
  command.confirmation = 5;
  const Buffer wire = test::fields(command);
  EXPECT_EQ(wire[3], 0x3F);  // of 1.0F
  EXPECT_EQ(wire[28], 400 % 256);
  EXPECT_EQ(wire[29], 1);
  EXPECT_EQ(wire[30], 3);
  EXPECT_EQ(wire[31], 4);
  EXPECT_EQ(wire[32], 5);
  CommandAck ack;
  ack.result = 4;
  ack.result_param2 = -2;
  ack.target_component = 6;
  EXPECT_EQ(test::fields(ack)[2], 4);
  EXPECT_EQ(test::fields(ack)[4], 0xFE);
  EXPECT_EQ(test::fields(ack)[9], 6);
}

}  // namespace
}  // namespace kestrel::mavlink

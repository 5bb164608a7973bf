#include "kestrel/link/vehicle_messages.hpp"

#include <gtest/gtest.h>

#include "samples.hpp"

namespace kestrel::mavlink {
namespace {

using test::Buffer;

TEST(VehicleMessages, AreACompanionComputerByDefault) {
  const Buffer wire = test::fields(Heartbeat{});
  EXPECT_EQ(wire, (Buffer{0, 0, 0, 0, 18, 8, 0, 4, 3}));
}

TEST(VehicleMessages, PutFieldsWhereTheStandardDoes) {
  SysStatus status;
  status.battery_mv = 0x1234;
  status.battery_percent = -1;
  status.sensors_health_extended = 0x01020304;
  const Buffer wire = test::fields(status);
  EXPECT_EQ(wire[14], 0x34);
  EXPECT_EQ(wire[15], 0x12);
  EXPECT_EQ(wire[30], 0xFF);
  EXPECT_EQ(wire[39], 0x04);
  StatusText text;
  text.text = {'O', 'k'};
  EXPECT_EQ(test::fields(text)[2], 'k');
  ServoOutputRaw servo;
  servo.servo16_us = 1500;
  EXPECT_EQ(test::fields(servo)[35], 1500 % 256);
  EXPECT_EQ(test::fields(ExtendedSysState{3, 2}), (Buffer{3, 2}));
}

}  // namespace
}  // namespace kestrel::mavlink

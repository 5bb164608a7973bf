#include "kestrel/link/motion_messages.hpp"

#include <gtest/gtest.h>

#include "samples.hpp"

namespace kestrel::mavlink {
namespace {

using test::Buffer;

TEST(MotionMessages, PutFieldsWhereTheStandardDoes) {
  LocalPosition position;
  position.time_boot_ms = 0x01020304;
  position.vz_m_s = -2;
  const Buffer wire = test::fields(position);
  EXPECT_EQ(wire[0], 0x04);
  EXPECT_EQ(wire[27], 0xC0);  // of -2.0F
  GlobalPosition global;
  global.heading_cdeg = 0x8CA0;
  EXPECT_EQ(test::fields(global)[26], 0xA0);
  AttitudeReport attitude;
  attitude.yaw_rate_rad_s = 1;
  EXPECT_EQ(test::fields(attitude)[27], 0x3F);
}

}  // namespace
}  // namespace kestrel::mavlink

#include "kestrel/link/message_info.hpp"

#include <gtest/gtest.h>

namespace kestrel::mavlink {
namespace {

struct Published {
  std::uint32_t id;
  const char* name;
  int crc_extra, length, longest;
};
// From the definitions of mavlink.io, "common".
constexpr Published kPublished[] = {
    {0, "HEARTBEAT", 50, 9, 9},
    {1, "SYS_STATUS", 124, 31, 43},
    {2, "SYSTEM_TIME", 137, 12, 12},
    {4, "PING", 237, 14, 14},
    {11, "SET_MODE", 89, 6, 6},
    {22, "PARAM_VALUE", 220, 25, 25},
    {23, "PARAM_SET", 168, 23, 23},
    {30, "ATTITUDE", 39, 28, 28},
    {31, "ATTITUDE_QUATERNION", 246, 32, 48},
    {32, "LOCAL_POSITION_NED", 185, 28, 28},
    {33, "GLOBAL_POSITION_INT", 104, 28, 28},
    {36, "SERVO_OUTPUT_RAW", 222, 21, 37},
    {66, "REQUEST_DATA_STREAM", 148, 6, 6},
    {69, "MANUAL_CONTROL", 243, 11, 30},
    {75, "COMMAND_INT", 158, 35, 35},
    {76, "COMMAND_LONG", 152, 33, 33},
    {77, "COMMAND_ACK", 143, 3, 10},
    {82, "SET_ATTITUDE_TARGET", 49, 39, 51},
    {83, "ATTITUDE_TARGET", 22, 37, 37},
    {84, "SET_POSITION_TARGET_LOCAL_NED", 143, 53, 53},
    {85, "POSITION_TARGET_LOCAL_NED", 140, 51, 51},
    {102, "VISION_POSITION_ESTIMATE", 158, 32, 117},
    {103, "VISION_SPEED_ESTIMATE", 208, 20, 57},
    {111, "TIMESYNC", 34, 16, 18},
    {148, "AUTOPILOT_VERSION", 178, 60, 78},
    {149, "LANDING_TARGET", 200, 30, 60},
    {244, "MESSAGE_INTERVAL", 95, 6, 6},
    {245, "EXTENDED_SYS_STATE", 130, 2, 2},
    {253, "STATUSTEXT", 83, 51, 54},
    {256, "SETUP_SIGNING", 71, 42, 42},
    {331, "ODOMETRY", 91, 230, 233},
};

TEST(MessageInfo, IsAsPublished) {
  ASSERT_EQ(message_infos().count, std::size(kPublished));
  for (const Published& published : kPublished) {
    const MessageInfo* info = message_info(published.id);
    ASSERT_NE(info, nullptr) << published.name;
    EXPECT_EQ(info->name, published.name);
    EXPECT_EQ(info->crc_extra, published.crc_extra) << published.name;
    EXPECT_EQ(info->length, published.length) << published.name;
    EXPECT_EQ(info->longest, published.longest) << published.name;
  }
}

TEST(MessageInfo, IsMissingForOthers) {
  for (const std::uint32_t id : {3U, 5U, 86U, 332U, 84U + 0x10000, 0xFFFFFFU, 0xFFFFFFFFU}) {
    EXPECT_EQ(message_info(id), nullptr) << id;
  }
}

// Fields follow one another without gaps, the largest type first until extensions begin.
TEST(MessageInfo, FieldsFillThePayload) {
  for (const MessageInfo& info : message_infos()) {
    std::size_t offset = 0;
    std::size_t largest = 8;
    for (const FieldInfo& field : info) {
      EXPECT_EQ(field.offset, offset) << info.name << ' ' << field.name;
      if (!field.extension) {
        EXPECT_LE(size_of(field.type), largest) << info.name << ' ' << field.name;
        largest = size_of(field.type);
      }
      EXPECT_EQ(field.extension, field.offset >= info.length) << info.name << ' ' << field.name;
      EXPECT_EQ(info.field(field.name), &field);
      offset += field.size();
    }
    EXPECT_EQ(offset, info.longest) << info.name;
  }
}

TEST(MessageInfo, FindsFieldsByName) {
  const MessageInfo& setpoint = *message_info(84);
  EXPECT_EQ(setpoint.field("vx")->offset, 16);
  EXPECT_EQ(setpoint.field("yaw_rate")->offset, 44);
  EXPECT_EQ(setpoint.field("target_system")->offset, 50);
  EXPECT_EQ(setpoint.field("nothing"), nullptr);
  EXPECT_EQ(message_info(331)->field("pose_covariance")->count, 21);
  EXPECT_EQ(name(message_info(331)->field("quality")->type), "int8_t");
}

}  // namespace
}  // namespace kestrel::mavlink

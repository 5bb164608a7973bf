#include "kestrel/link/flight_rules.hpp"

#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "samples.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

using mavlink::Message;

std::optional<Refused> verdict(const Message& message, const FlightSender& sender) {
  const auto frame = mavlink::encode(message, {1, 191, 0});
  return refused_for_flight(std::get<mavlink::FrameView>(mavlink::parse(frame.bytes()).content),
                            sender);
}

FlightSender in_control(LinkRole role, const LinkPermissions& may = {}) {
  return {role, may, ControlState::Owned, true};
}

Message command(int number, float param1 = 0) {
  mavlink::CommandLong message;
  message.command = std::uint16_t(number);
  message.param1 = param1;
  return message;
}

/// Every message, with zeros in its fields, that the role may send.
std::set<std::string_view> passed(const FlightSender& sender) {
  std::set<std::string_view> names;
  for (const mavlink::MessageInfo& info : mavlink::message_infos()) {
    if (!verdict(*mavlink::message_of(info.id, {}), sender)) names.insert(info.name);
  }
  return names;
}

TEST(FlightRules, PassWhatTheTableSaysAndNothingElse) {
  using Names = std::set<std::string_view>;
  EXPECT_EQ(passed(in_control(LinkRole::Ground)),
            (Names{"HEARTBEAT", "PING", "TIMESYNC", "REQUEST_DATA_STREAM", "SYSTEM_TIME",
                   "COMMAND_ACK", "SET_MODE", "PARAM_SET", "COMMAND_LONG", "COMMAND_INT"}));
  EXPECT_EQ(passed(in_control(LinkRole::Vision)),
            (Names{"HEARTBEAT", "PING", "TIMESYNC", "REQUEST_DATA_STREAM"}));
  EXPECT_EQ(passed(in_control(LinkRole::Script)), (Names{"HEARTBEAT", "PING", "TIMESYNC"}));
  EXPECT_EQ(passed(in_control(LinkRole::Telemetry)), Names{});
  EXPECT_EQ(passed(in_control(LinkRole::Flight)), Names{});
  LinkPermissions all;
  all.arm = all.manual_control = all.aid_estimator = true;
  EXPECT_EQ(passed(in_control(LinkRole::Telemetry, all)), Names{});
  EXPECT_EQ(passed(in_control(LinkRole::Ground, all)).count("MANUAL_CONTROL"), 1u);
  EXPECT_EQ(passed(in_control(LinkRole::Ground, all)).count("ODOMETRY"), 0u);
  const auto vision = passed(in_control(LinkRole::Vision, all));
  for (const char* aid :
       {"LANDING_TARGET", "VISION_POSITION_ESTIMATE", "VISION_SPEED_ESTIMATE", "ODOMETRY"}) {
    EXPECT_EQ(vision.count(aid), 1u) << aid;
  }
  EXPECT_EQ(vision.count("MANUAL_CONTROL"), 0u);
}

TEST(FlightRules, LetCompanionsCommandLittle) {
  LinkPermissions arming;
  arming.arm = true;
  for (const LinkRole role : {LinkRole::Vision, LinkRole::Script}) {
    const FlightSender other{role, arming, ControlState::Owned, false};
    const FlightSender stopped{role, arming, ControlState::Stopped, false};
    for (int number = 0; number < 66; ++number) {
      const std::map<int, int> kinds = {{20, 1},  {21, 1},  {22, 2}, {176, 1},
                                        {400, 2}, {511, 0}, {512, 0}};
      const int asked = number < 60
                            ? number
                            : std::array{176, 400, 511, 512, 31010, 246}[std::size_t(number - 60)];
      const int kind = kinds.count(asked) > 0 ? kinds.at(asked) : 3;
      const auto plain = verdict(command(asked, 1), in_control(role));
      const auto armed = verdict(command(asked, 1), in_control(role, arming));
      EXPECT_EQ(!plain, kind <= 1) << asked;
      EXPECT_EQ(!armed, kind <= 2) << asked;
      if (kind == 1 || kind == 2) {
        EXPECT_EQ(verdict(command(asked, 1), other), Refused::NotOwner) << asked;
        EXPECT_EQ(verdict(command(asked, 1), stopped), Refused::Stopped) << asked;
      }
    }
  }
}

TEST(FlightRules, LetTheGroundLandButNotStartWhileStopped) {
  FlightSender ground = in_control(LinkRole::Ground);
  ground.may.manual_control = true;
  const mavlink::CommandInt take_off{0, 0, 0, 0, 0, 0, 5, 22, 1, 1, 0, 0, 0};
  EXPECT_FALSE(verdict(command(400, 1), ground));
  EXPECT_FALSE(verdict(take_off, ground));
  ground.control = ControlState::Stopped;
  for (const Message& start : {command(400, 1), command(22), command(24), command(84), command(300),
                               Message(take_off), Message(mavlink::ManualControl{})}) {
    EXPECT_EQ(verdict(start, ground), Refused::Stopped);
  }
  for (const Message& end : {command(400, 0), command(21), command(20), command(176)}) {
    EXPECT_FALSE(verdict(end, ground));
  }
}

TEST(FlightRules, PassNoFloatThatIsNotFinite) {
  test::Random random("flight rules");
  LinkPermissions all;
  all.aid_estimator = all.manual_control = true;
  long tried = 0;
  for (const mavlink::MessageInfo& info : mavlink::message_infos()) {
    for (const mavlink::FieldInfo& field : info) {
      if (field.type != mavlink::FieldType::Float) continue;
      for (std::size_t at = field.offset; at < field.offset + field.size(); at += 4) {
        test::Buffer payload(info.longest);
        const std::uint32_t bits[] = {0x7F800000, 0xFF800000, 0x7FC00000, 0xFFFFFFFF, 0x7F800001};
        const std::uint32_t bad = bits[random.integer(0, 4)];
        for (std::size_t k = 0; k < 4; ++k) payload[at + k] = std::uint8_t(bad >> (8 * k));
        const auto message = *mavlink::message_of(info.id, test::view(payload));
        EXPECT_TRUE(verdict(message, in_control(LinkRole::Ground, all))) << info.name;
        EXPECT_TRUE(verdict(message, in_control(LinkRole::Vision, all))) << info.name;
        ++tried;
      }
    }
  }
  EXPECT_GT(tried, 150);
  mavlink::ParamSet parameter;
  parameter.param_value = std::numeric_limits<float>::max();
  EXPECT_FALSE(verdict(parameter, in_control(LinkRole::Ground)));
  parameter.param_value = std::numeric_limits<float>::infinity();
  EXPECT_EQ(verdict(parameter, in_control(LinkRole::Ground)), Refused::NotFinite);
}

TEST(FlightRules, PassNothingUnknown) {
  const auto frame = test::hand_made_frame(20, {1, 2, 3}, 0);  // PARAM_REQUEST_READ
  const auto view = std::get<mavlink::FrameView>(mavlink::parse(test::view(frame)).content);
  EXPECT_EQ(refused_for_flight(view, in_control(LinkRole::Ground)), Refused::NotAllowed);
}

}  // namespace
}  // namespace kestrel

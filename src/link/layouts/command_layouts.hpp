#pragma once

#include "kestrel/link/command_messages.hpp"

#include "layout.hpp"

namespace kestrel::mavlink {

template <>
struct Layout<CommandLong> {
  static constexpr std::string_view kName = "COMMAND_LONG";
  static constexpr std::uint32_t kId = 76;
  static constexpr std::uint8_t kCrcExtra = 152;
  static constexpr std::size_t kLength = 33;
  static constexpr auto kFields = std::make_tuple(
      field("param1", &CommandLong::param1), field("param2", &CommandLong::param2),
      field("param3", &CommandLong::param3), field("param4", &CommandLong::param4),
      field("param5", &CommandLong::param5), field("param6", &CommandLong::param6),
      field("param7", &CommandLong::param7), field("command", &CommandLong::command),
      field("target_system", &CommandLong::target_system),
      field("target_component", &CommandLong::target_component),
      field("confirmation", &CommandLong::confirmation));
};
static_assert(as_published<CommandLong>());

template <>
struct Layout<CommandInt> {
  static constexpr std::string_view kName = "COMMAND_INT";
  static constexpr std::uint32_t kId = 75;
  static constexpr std::uint8_t kCrcExtra = 158;
  static constexpr std::size_t kLength = 35;
  static constexpr auto kFields = std::make_tuple(
      field("param1", &CommandInt::param1), field("param2", &CommandInt::param2),
      field("param3", &CommandInt::param3), field("param4", &CommandInt::param4),
      field("x", &CommandInt::x), field("y", &CommandInt::y), field("z", &CommandInt::z),
      field("command", &CommandInt::command), field("target_system", &CommandInt::target_system),
      field("target_component", &CommandInt::target_component), field("frame", &CommandInt::frame),
      field("current", &CommandInt::current), field("autocontinue", &CommandInt::autocontinue));
};
static_assert(as_published<CommandInt>());

template <>
struct Layout<CommandAck> {
  static constexpr std::string_view kName = "COMMAND_ACK";
  static constexpr std::uint32_t kId = 77;
  static constexpr std::uint8_t kCrcExtra = 143;
  static constexpr std::size_t kLength = 3;
  static constexpr std::size_t kLongest = 10;
  static constexpr auto kFields =
      std::make_tuple(field("command", &CommandAck::command), field("result", &CommandAck::result));
  static constexpr auto kExtensions = std::make_tuple(
      field("progress", &CommandAck::progress), field("result_param2", &CommandAck::result_param2),
      field("target_system", &CommandAck::target_system),
      field("target_component", &CommandAck::target_component));
};
static_assert(as_published<CommandAck>());

template <>
struct Layout<SetMode> {
  static constexpr std::string_view kName = "SET_MODE";
  static constexpr std::uint32_t kId = 11;
  static constexpr std::uint8_t kCrcExtra = 89;
  static constexpr std::size_t kLength = 6;
  static constexpr auto kFields = std::make_tuple(field("custom_mode", &SetMode::custom_mode),
                                                  field("target_system", &SetMode::target_system),
                                                  field("base_mode", &SetMode::base_mode));
};
static_assert(as_published<SetMode>());

template <>
struct Layout<ParamSet> {
  static constexpr std::string_view kName = "PARAM_SET";
  static constexpr std::uint32_t kId = 23;
  static constexpr std::uint8_t kCrcExtra = 168;
  static constexpr std::size_t kLength = 23;
  static constexpr auto kFields = std::make_tuple(
      field("param_value", &ParamSet::param_value),
      field("target_system", &ParamSet::target_system),
      field("target_component", &ParamSet::target_component),
      field("param_id", &ParamSet::param_id), field("param_type", &ParamSet::param_type));
};
static_assert(as_published<ParamSet>());

template <>
struct Layout<ParamValue> {
  static constexpr std::string_view kName = "PARAM_VALUE";
  static constexpr std::uint32_t kId = 22;
  static constexpr std::uint8_t kCrcExtra = 220;
  static constexpr std::size_t kLength = 25;
  static constexpr auto kFields = std::make_tuple(field("param_value", &ParamValue::param_value),
                                                  field("param_count", &ParamValue::param_count),
                                                  field("param_index", &ParamValue::param_index),
                                                  field("param_id", &ParamValue::param_id),
                                                  field("param_type", &ParamValue::param_type));
};
static_assert(as_published<ParamValue>());

template <>
struct Layout<ManualControl> {
  static constexpr std::string_view kName = "MANUAL_CONTROL";
  static constexpr std::uint32_t kId = 69;
  static constexpr std::uint8_t kCrcExtra = 243;
  static constexpr std::size_t kLength = 11;
  static constexpr std::size_t kLongest = 30;
  static constexpr auto kFields = std::make_tuple(
      field("x", &ManualControl::x), field("y", &ManualControl::y), field("z", &ManualControl::z),
      field("r", &ManualControl::r), field("buttons", &ManualControl::buttons),
      field("target", &ManualControl::target));
  static constexpr auto kExtensions =
      std::make_tuple(field("buttons2", &ManualControl::buttons2),
                      field("enabled_extensions", &ManualControl::enabled_extensions),
                      field("s", &ManualControl::s), field("t", &ManualControl::t),
                      field("aux1", &ManualControl::aux1), field("aux2", &ManualControl::aux2),
                      field("aux3", &ManualControl::aux3), field("aux4", &ManualControl::aux4),
                      field("aux5", &ManualControl::aux5), field("aux6", &ManualControl::aux6));
};
static_assert(as_published<ManualControl>());

template <>
struct Layout<SetupSigning> {
  static constexpr std::string_view kName = "SETUP_SIGNING";
  static constexpr std::uint32_t kId = 256;
  static constexpr std::uint8_t kCrcExtra = 71;
  static constexpr std::size_t kLength = 42;
  static constexpr auto kFields =
      std::make_tuple(field("initial_timestamp", &SetupSigning::initial_timestamp),
                      field("target_system", &SetupSigning::target_system),
                      field("target_component", &SetupSigning::target_component),
                      field("secret_key", &SetupSigning::secret_key));
};
static_assert(as_published<SetupSigning>());

template <>
struct Layout<MessageInterval> {
  static constexpr std::string_view kName = "MESSAGE_INTERVAL";
  static constexpr std::uint32_t kId = 244;
  static constexpr std::uint8_t kCrcExtra = 95;
  static constexpr std::size_t kLength = 6;
  static constexpr auto kFields =
      std::make_tuple(field("interval_us", &MessageInterval::interval_us),
                      field("message_id", &MessageInterval::message_id));
};
static_assert(as_published<MessageInterval>());

template <>
struct Layout<RequestDataStream> {
  static constexpr std::string_view kName = "REQUEST_DATA_STREAM";
  static constexpr std::uint32_t kId = 66;
  static constexpr std::uint8_t kCrcExtra = 148;
  static constexpr std::size_t kLength = 6;
  static constexpr auto kFields =
      std::make_tuple(field("req_message_rate", &RequestDataStream::rate_hz),
                      field("target_system", &RequestDataStream::target_system),
                      field("target_component", &RequestDataStream::target_component),
                      field("req_stream_id", &RequestDataStream::stream_id),
                      field("start_stop", &RequestDataStream::start_stop));
};
static_assert(as_published<RequestDataStream>());

}  // namespace kestrel::mavlink

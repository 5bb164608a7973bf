#pragma once

#include <array>
#include <cstdint>

// MAVLink messages (mavlink.io, "common"): what is asked of a vehicle, setpoints apart. Units are
// in the names; fields after "extensions" are missing in the frames of older senders, and are then
// zero.
namespace kestrel::mavlink {

/// COMMAND_LONG (76): do this; what the parameters mean depends on `command` (MAV_CMD).
struct CommandLong {
  float param1 = 0;
  float param2 = 0;
  float param3 = 0;
  float param4 = 0;
  float param5 = 0;
  float param6 = 0;
  float param7 = 0;
  std::uint16_t command = 0;
  std::uint8_t target_system = 0;     // 0: all
  std::uint8_t target_component = 0;  // 0: all
  std::uint8_t confirmation = 0;
};

/// COMMAND_INT (75): do this, with a place: x and y are 1e7 degrees or 1e4 m by `frame`, z is m.
struct CommandInt {
  float param1 = 0;
  float param2 = 0;
  float param3 = 0;
  float param4 = 0;
  std::int32_t x = 0;
  std::int32_t y = 0;
  float z = 0;
  std::uint16_t command = 0;
  std::uint8_t target_system = 0;     // 0: all
  std::uint8_t target_component = 0;  // 0: all
  std::uint8_t frame = 0;
  std::uint8_t current = 0;
  std::uint8_t autocontinue = 0;
};

/// COMMAND_ACK (77): what became of a command (MAV_RESULT; 0 is accepted).
struct CommandAck {
  std::uint16_t command = 0;
  std::uint8_t result = 0;
  // extensions
  std::uint8_t progress = 0;
  std::int32_t result_param2 = 0;
  std::uint8_t target_system = 0;     // 0: all
  std::uint8_t target_component = 0;  // 0: all
};

/// SET_MODE (11): flight mode, the old way; ARM and modes go by COMMAND_LONG today.
struct SetMode {
  std::uint32_t custom_mode = 0;
  std::uint8_t target_system = 0;  // 0: all
  std::uint8_t base_mode = 0;
};

/// PARAM_SET (23): writes a parameter; `param_id` ends at its first zero byte, or nowhere.
struct ParamSet {
  float param_value = 0;
  std::uint8_t target_system = 0;     // 0: all
  std::uint8_t target_component = 0;  // 0: all
  std::array<char, 16> param_id{};
  std::uint8_t param_type = 0;
};

/// PARAM_VALUE (22): a parameter as it stands.
struct ParamValue {
  float param_value = 0;
  std::uint16_t param_count = 0;
  std::uint16_t param_index = 0;
  std::array<char, 16> param_id{};
  std::uint8_t param_type = 0;
};

/// MANUAL_CONTROL (69): sticks, each -1000 to 1000, 32767 for none.
struct ManualControl {
  std::int16_t x = 0;
  std::int16_t y = 0;
  std::int16_t z = 0;
  std::int16_t r = 0;
  std::uint16_t buttons = 0;
  std::uint8_t target = 0;
  // extensions
  std::uint16_t buttons2 = 0;
  std::uint8_t enabled_extensions = 0;
  std::int16_t s = 0;
  std::int16_t t = 0;
  std::int16_t aux1 = 0;
  std::int16_t aux2 = 0;
  std::int16_t aux3 = 0;
  std::int16_t aux4 = 0;
  std::int16_t aux5 = 0;
  std::int16_t aux6 = 0;
};

/// SETUP_SIGNING (256): gives a key to the one addressed. Never forwarded from one link to
/// another.
struct SetupSigning {
  std::uint64_t initial_timestamp = 0;
  std::uint8_t target_system = 0;     // 0: all
  std::uint8_t target_component = 0;  // 0: all
  std::array<std::uint8_t, 32> secret_key{};
};

/// MESSAGE_INTERVAL (244): how often a message is sent.
struct MessageInterval {
  std::int32_t interval_us = 0;
  std::uint16_t message_id = 0;
};

/// REQUEST_DATA_STREAM (66): asks for a group of messages, the old way.
struct RequestDataStream {
  std::uint16_t rate_hz = 0;
  std::uint8_t target_system = 0;     // 0: all
  std::uint8_t target_component = 0;  // 0: all
  std::uint8_t stream_id = 0;
  std::uint8_t start_stop = 0;
};

}  // namespace kestrel::mavlink

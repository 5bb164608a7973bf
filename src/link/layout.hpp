#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "kestrel/link/crc.hpp"
#include "kestrel/link/message.hpp"

// The tables of the codec. A new message is a struct, a Layout and a place in the variant; the
// asserts below then compare its names, types, order and length with the published ones.
namespace kestrel::mavlink {

template <class Struct, class Value>
struct Field {
  using Type = Value;
  std::string_view name;  // as in the message definition
  Value Struct::*member;
};

template <class Struct, class Value>
constexpr Field<Struct, Value> field(std::string_view name, Value Struct::*member) {
  return {name, member};
}

/// The message's name, id, published CRC_EXTRA and length, and its fields in the order of the
/// wire: by falling size of their type, else as defined.
template <class M>
struct Layout;

template <>
struct Layout<Heartbeat> {
  static constexpr std::string_view kName = "HEARTBEAT";
  static constexpr std::uint32_t kId = 0;
  static constexpr std::uint8_t kCrcExtra = 50;
  static constexpr std::size_t kLength = 9;
  static constexpr auto kFields = std::make_tuple(
      field("custom_mode", &Heartbeat::custom_mode),  //
      field("type", &Heartbeat::type),                //
      field("autopilot", &Heartbeat::autopilot),      //
      field("base_mode", &Heartbeat::base_mode), field("system_status", &Heartbeat::system_status),
      field("mavlink_version", &Heartbeat::mavlink_version));
};

template <>
struct Layout<SetPositionTarget> {
  static constexpr std::string_view kName = "SET_POSITION_TARGET_LOCAL_NED";
  static constexpr std::uint32_t kId = 84;
  static constexpr std::uint8_t kCrcExtra = 143;
  static constexpr std::size_t kLength = 53;
  static constexpr auto kFields =
      std::make_tuple(field("time_boot_ms", &SetPositionTarget::time_boot_ms),  //
                      field("x", &SetPositionTarget::x_m),                      //
                      field("y", &SetPositionTarget::y_m),                      //
                      field("z", &SetPositionTarget::z_m),                      //
                      field("vx", &SetPositionTarget::vx_m_s),                  //
                      field("vy", &SetPositionTarget::vy_m_s),                  //
                      field("vz", &SetPositionTarget::vz_m_s),                  //
                      field("afx", &SetPositionTarget::ax_m_s2),                //
                      field("afy", &SetPositionTarget::ay_m_s2),                //
                      field("afz", &SetPositionTarget::az_m_s2),                //
                      field("yaw", &SetPositionTarget::yaw_rad),                //
                      field("yaw_rate", &SetPositionTarget::yaw_rate_rad_s),    //
                      field("type_mask", &SetPositionTarget::type_mask),        //
                      field("target_system", &SetPositionTarget::target_system),
                      field("target_component", &SetPositionTarget::target_component),
                      field("coordinate_frame", &SetPositionTarget::coordinate_frame));
};

/// The name of a type in message definitions.
template <class T>
constexpr std::string_view type_name() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return "uint8_t";
  if constexpr (std::is_same_v<T, std::uint16_t>) return "uint16_t";
  if constexpr (std::is_same_v<T, std::uint32_t>) return "uint32_t";
  if constexpr (std::is_same_v<T, float>) return "float";
}

constexpr std::uint16_t crc_add(std::uint16_t crc, std::string_view text) {
  for (const char letter : text) {
    crc = kestrel::crc_add(crc, static_cast<std::uint8_t>(letter));
  }
  return kestrel::crc_add(crc, std::uint8_t{' '});
}

/// The byte that makes the checksum depend on the definition: the checksum of its name, then of
/// each field's type and name, folded to eight bits (mavlink.io, "CRC_EXTRA Calculation").
template <class M>
constexpr std::uint8_t crc_extra() {
  const std::uint16_t crc = std::apply(
      [](const auto&... fields) {
        std::uint16_t sum = crc_add(kCrcStart, Layout<M>::kName);
        ((sum = crc_add(crc_add(sum, type_name<typename std::decay_t<decltype(fields)>::Type>()),
                        fields.name)),
         ...);
        return sum;
      },
      Layout<M>::kFields);
  return static_cast<std::uint8_t>((crc & 0xFF) ^ (crc >> 8));
}

/// Bytes of the payload before trimming.
template <class M>
constexpr std::size_t length() {
  return std::apply(
      [](const auto&... fields) {
        return (sizeof(typename std::decay_t<decltype(fields)>::Type) + ...);
      },
      Layout<M>::kFields);
}

template <class M>
constexpr bool as_published() {
  return crc_extra<M>() == Layout<M>::kCrcExtra && length<M>() == Layout<M>::kLength &&
         length<M>() <= kMaxPayload;
}
static_assert(as_published<Heartbeat>());
static_assert(as_published<SetPositionTarget>());

}  // namespace kestrel::mavlink

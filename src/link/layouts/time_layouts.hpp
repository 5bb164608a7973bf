#pragma once

#include "kestrel/link/time_messages.hpp"

#include "layout.hpp"

namespace kestrel::mavlink {

template <>
struct Layout<SystemTime> {
  static constexpr std::string_view kName = "SYSTEM_TIME";
  static constexpr std::uint32_t kId = 2;
  static constexpr std::uint8_t kCrcExtra = 137;
  static constexpr std::size_t kLength = 12;
  static constexpr auto kFields =
      std::make_tuple(field("time_unix_usec", &SystemTime::time_unix_us),
                      field("time_boot_ms", &SystemTime::time_boot_ms));
};
static_assert(as_published<SystemTime>());

template <>
struct Layout<Ping> {
  static constexpr std::string_view kName = "PING";
  static constexpr std::uint32_t kId = 4;
  static constexpr std::uint8_t kCrcExtra = 237;
  static constexpr std::size_t kLength = 14;
  static constexpr auto kFields =
      std::make_tuple(field("time_usec", &Ping::time_us), field("seq", &Ping::seq),
                      field("target_system", &Ping::target_system),
                      field("target_component", &Ping::target_component));
};
static_assert(as_published<Ping>());

template <>
struct Layout<TimeSync> {
  static constexpr std::string_view kName = "TIMESYNC";
  static constexpr std::uint32_t kId = 111;
  static constexpr std::uint8_t kCrcExtra = 34;
  static constexpr std::size_t kLength = 16;
  static constexpr std::size_t kLongest = 18;
  static constexpr auto kFields =
      std::make_tuple(field("tc1", &TimeSync::tc1_ns), field("ts1", &TimeSync::ts1_ns));
  static constexpr auto kExtensions =
      std::make_tuple(field("target_system", &TimeSync::target_system),
                      field("target_component", &TimeSync::target_component));
};
static_assert(as_published<TimeSync>());

}  // namespace kestrel::mavlink

#pragma once

#include "kestrel/link/motion_messages.hpp"

#include "layout.hpp"

namespace kestrel::mavlink {

template <>
struct Layout<AttitudeReport> {
  static constexpr std::string_view kName = "ATTITUDE";
  static constexpr std::uint32_t kId = 30;
  static constexpr std::uint8_t kCrcExtra = 39;
  static constexpr std::size_t kLength = 28;
  static constexpr auto kFields = std::make_tuple(
      field("time_boot_ms", &AttitudeReport::time_boot_ms),
      field("roll", &AttitudeReport::roll_rad), field("pitch", &AttitudeReport::pitch_rad),
      field("yaw", &AttitudeReport::yaw_rad), field("rollspeed", &AttitudeReport::roll_rate_rad_s),
      field("pitchspeed", &AttitudeReport::pitch_rate_rad_s),
      field("yawspeed", &AttitudeReport::yaw_rate_rad_s));
};
static_assert(as_published<AttitudeReport>());

template <>
struct Layout<AttitudeQuaternion> {
  static constexpr std::string_view kName = "ATTITUDE_QUATERNION";
  static constexpr std::uint32_t kId = 31;
  static constexpr std::uint8_t kCrcExtra = 246;
  static constexpr std::size_t kLength = 32;
  static constexpr std::size_t kLongest = 48;
  static constexpr auto kFields =
      std::make_tuple(field("time_boot_ms", &AttitudeQuaternion::time_boot_ms),
                      field("q1", &AttitudeQuaternion::q1), field("q2", &AttitudeQuaternion::q2),
                      field("q3", &AttitudeQuaternion::q3), field("q4", &AttitudeQuaternion::q4),
                      field("rollspeed", &AttitudeQuaternion::roll_rate_rad_s),
                      field("pitchspeed", &AttitudeQuaternion::pitch_rate_rad_s),
                      field("yawspeed", &AttitudeQuaternion::yaw_rate_rad_s));
  static constexpr auto kExtensions =
      std::make_tuple(field("repr_offset_q", &AttitudeQuaternion::repr_offset_q));
};
static_assert(as_published<AttitudeQuaternion>());

template <>
struct Layout<LocalPosition> {
  static constexpr std::string_view kName = "LOCAL_POSITION_NED";
  static constexpr std::uint32_t kId = 32;
  static constexpr std::uint8_t kCrcExtra = 185;
  static constexpr std::size_t kLength = 28;
  static constexpr auto kFields =
      std::make_tuple(field("time_boot_ms", &LocalPosition::time_boot_ms),
                      field("x", &LocalPosition::x_m), field("y", &LocalPosition::y_m),
                      field("z", &LocalPosition::z_m), field("vx", &LocalPosition::vx_m_s),
                      field("vy", &LocalPosition::vy_m_s), field("vz", &LocalPosition::vz_m_s));
};
static_assert(as_published<LocalPosition>());

template <>
struct Layout<GlobalPosition> {
  static constexpr std::string_view kName = "GLOBAL_POSITION_INT";
  static constexpr std::uint32_t kId = 33;
  static constexpr std::uint8_t kCrcExtra = 104;
  static constexpr std::size_t kLength = 28;
  static constexpr auto kFields = std::make_tuple(
      field("time_boot_ms", &GlobalPosition::time_boot_ms),
      field("lat", &GlobalPosition::latitude_deg_e7),
      field("lon", &GlobalPosition::longitude_deg_e7), field("alt", &GlobalPosition::altitude_mm),
      field("relative_alt", &GlobalPosition::relative_altitude_mm),
      field("vx", &GlobalPosition::vx_cm_s), field("vy", &GlobalPosition::vy_cm_s),
      field("vz", &GlobalPosition::vz_cm_s), field("hdg", &GlobalPosition::heading_cdeg));
};
static_assert(as_published<GlobalPosition>());

template <>
struct Layout<SetAttitudeTarget> {
  static constexpr std::string_view kName = "SET_ATTITUDE_TARGET";
  static constexpr std::uint32_t kId = 82;
  static constexpr std::uint8_t kCrcExtra = 49;
  static constexpr std::size_t kLength = 39;
  static constexpr std::size_t kLongest = 51;
  static constexpr auto kFields = std::make_tuple(
      field("time_boot_ms", &SetAttitudeTarget::time_boot_ms), field("q", &SetAttitudeTarget::q),
      field("body_roll_rate", &SetAttitudeTarget::roll_rate_rad_s),
      field("body_pitch_rate", &SetAttitudeTarget::pitch_rate_rad_s),
      field("body_yaw_rate", &SetAttitudeTarget::yaw_rate_rad_s),
      field("thrust", &SetAttitudeTarget::thrust),
      field("target_system", &SetAttitudeTarget::target_system),
      field("target_component", &SetAttitudeTarget::target_component),
      field("type_mask", &SetAttitudeTarget::type_mask));
  static constexpr auto kExtensions =
      std::make_tuple(field("thrust_body", &SetAttitudeTarget::thrust_body));
};
static_assert(as_published<SetAttitudeTarget>());

template <>
struct Layout<AttitudeTarget> {
  static constexpr std::string_view kName = "ATTITUDE_TARGET";
  static constexpr std::uint32_t kId = 83;
  static constexpr std::uint8_t kCrcExtra = 22;
  static constexpr std::size_t kLength = 37;
  static constexpr auto kFields = std::make_tuple(
      field("time_boot_ms", &AttitudeTarget::time_boot_ms), field("q", &AttitudeTarget::q),
      field("body_roll_rate", &AttitudeTarget::roll_rate_rad_s),
      field("body_pitch_rate", &AttitudeTarget::pitch_rate_rad_s),
      field("body_yaw_rate", &AttitudeTarget::yaw_rate_rad_s),
      field("thrust", &AttitudeTarget::thrust), field("type_mask", &AttitudeTarget::type_mask));
};
static_assert(as_published<AttitudeTarget>());

template <>
struct Layout<SetPositionTarget> {
  static constexpr std::string_view kName = "SET_POSITION_TARGET_LOCAL_NED";
  static constexpr std::uint32_t kId = 84;
  static constexpr std::uint8_t kCrcExtra = 143;
  static constexpr std::size_t kLength = 53;
  static constexpr auto kFields = std::make_tuple(
      field("time_boot_ms", &SetPositionTarget::time_boot_ms), field("x", &SetPositionTarget::x_m),
      field("y", &SetPositionTarget::y_m), field("z", &SetPositionTarget::z_m),
      field("vx", &SetPositionTarget::vx_m_s), field("vy", &SetPositionTarget::vy_m_s),
      field("vz", &SetPositionTarget::vz_m_s), field("afx", &SetPositionTarget::ax_m_s2),
      field("afy", &SetPositionTarget::ay_m_s2), field("afz", &SetPositionTarget::az_m_s2),
      field("yaw", &SetPositionTarget::yaw_rad),
      field("yaw_rate", &SetPositionTarget::yaw_rate_rad_s),
      field("type_mask", &SetPositionTarget::type_mask),
      field("target_system", &SetPositionTarget::target_system),
      field("target_component", &SetPositionTarget::target_component),
      field("coordinate_frame", &SetPositionTarget::coordinate_frame));
};
static_assert(as_published<SetPositionTarget>());

template <>
struct Layout<PositionTarget> {
  static constexpr std::string_view kName = "POSITION_TARGET_LOCAL_NED";
  static constexpr std::uint32_t kId = 85;
  static constexpr std::uint8_t kCrcExtra = 140;
  static constexpr std::size_t kLength = 51;
  static constexpr auto kFields = std::make_tuple(
      field("time_boot_ms", &PositionTarget::time_boot_ms), field("x", &PositionTarget::x_m),
      field("y", &PositionTarget::y_m), field("z", &PositionTarget::z_m),
      field("vx", &PositionTarget::vx_m_s), field("vy", &PositionTarget::vy_m_s),
      field("vz", &PositionTarget::vz_m_s), field("afx", &PositionTarget::ax_m_s2),
      field("afy", &PositionTarget::ay_m_s2), field("afz", &PositionTarget::az_m_s2),
      field("yaw", &PositionTarget::yaw_rad), field("yaw_rate", &PositionTarget::yaw_rate_rad_s),
      field("type_mask", &PositionTarget::type_mask),
      field("coordinate_frame", &PositionTarget::coordinate_frame));
};
static_assert(as_published<PositionTarget>());

}  // namespace kestrel::mavlink

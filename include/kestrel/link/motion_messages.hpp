#pragma once

#include <array>
#include <cstdint>

// MAVLink messages (mavlink.io, "common"): where a vehicle is, how it moves and how it shall.
// Units are in the names; fields after "extensions" are missing in the frames of older senders,
// and are then zero.
namespace kestrel::mavlink {

/// ATTITUDE (30): attitude and rates of the body (FRD) against north, east, down.
struct AttitudeReport {
  std::uint32_t time_boot_ms = 0;
  float roll_rad = 0;
  float pitch_rad = 0;
  float yaw_rad = 0;
  float roll_rate_rad_s = 0;
  float pitch_rate_rad_s = 0;
  float yaw_rate_rad_s = 0;
};

/// ATTITUDE_QUATERNION (31): the same as a quaternion w, x, y, z.
struct AttitudeQuaternion {
  std::uint32_t time_boot_ms = 0;
  float q1 = 0;
  float q2 = 0;
  float q3 = 0;
  float q4 = 0;
  float roll_rate_rad_s = 0;
  float pitch_rate_rad_s = 0;
  float yaw_rate_rad_s = 0;
  // extensions
  std::array<float, 4> repr_offset_q{};
};

/// LOCAL_POSITION_NED (32): position and velocity, north, east, down from the local origin.
struct LocalPosition {
  std::uint32_t time_boot_ms = 0;
  float x_m = 0;
  float y_m = 0;
  float z_m = 0;
  float vx_m_s = 0;
  float vy_m_s = 0;
  float vz_m_s = 0;
};

/// GLOBAL_POSITION_INT (33): position on the earth.
struct GlobalPosition {
  std::uint32_t time_boot_ms = 0;
  std::int32_t latitude_deg_e7 = 0;
  std::int32_t longitude_deg_e7 = 0;
  std::int32_t altitude_mm = 0;
  std::int32_t relative_altitude_mm = 0;
  std::int16_t vx_cm_s = 0;
  std::int16_t vy_cm_s = 0;
  std::int16_t vz_cm_s = 0;
  std::uint16_t heading_cdeg = 0;
};

/// SET_ATTITUDE_TARGET (82): asks for an attitude, rates and thrust. Kestrel never sends it.
struct SetAttitudeTarget {
  std::uint32_t time_boot_ms = 0;
  std::array<float, 4> q{};
  float roll_rate_rad_s = 0;
  float pitch_rate_rad_s = 0;
  float yaw_rate_rad_s = 0;
  float thrust = 0;
  std::uint8_t target_system = 0;     // 0: all
  std::uint8_t target_component = 0;  // 0: all
  std::uint8_t type_mask = 0;
  // extensions
  std::array<float, 3> thrust_body{};
};

/// ATTITUDE_TARGET (83): the attitude the autopilot follows.
struct AttitudeTarget {
  std::uint32_t time_boot_ms = 0;
  std::array<float, 4> q{};
  float roll_rate_rad_s = 0;
  float pitch_rate_rad_s = 0;
  float yaw_rate_rad_s = 0;
  float thrust = 0;
  std::uint8_t type_mask = 0;
};

/// SET_POSITION_TARGET_LOCAL_NED (84): a setpoint for the flight controller, in the frame that
/// coordinate_frame names; a bit set in type_mask says that a field is to be ignored.
struct SetPositionTarget {
  std::uint32_t time_boot_ms = 0;
  float x_m = 0;
  float y_m = 0;
  float z_m = 0;
  float vx_m_s = 0;
  float vy_m_s = 0;
  float vz_m_s = 0;
  float ax_m_s2 = 0;
  float ay_m_s2 = 0;
  float az_m_s2 = 0;
  float yaw_rad = 0;
  float yaw_rate_rad_s = 0;
  std::uint16_t type_mask = 0;
  std::uint8_t target_system = 0;     // 0: all
  std::uint8_t target_component = 0;  // 0: all
  std::uint8_t coordinate_frame = 0;  // MAV_FRAME
};

/// POSITION_TARGET_LOCAL_NED (85): the setpoint the autopilot follows.
struct PositionTarget {
  std::uint32_t time_boot_ms = 0;
  float x_m = 0;
  float y_m = 0;
  float z_m = 0;
  float vx_m_s = 0;
  float vy_m_s = 0;
  float vz_m_s = 0;
  float ax_m_s2 = 0;
  float ay_m_s2 = 0;
  float az_m_s2 = 0;
  float yaw_rad = 0;
  float yaw_rate_rad_s = 0;
  std::uint16_t type_mask = 0;
  std::uint8_t coordinate_frame = 0;
};

}  // namespace kestrel::mavlink

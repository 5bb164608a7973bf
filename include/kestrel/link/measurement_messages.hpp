#pragma once

#include <array>
#include <cstdint>

// MAVLink messages (mavlink.io, "common"): what a camera or an estimator measured. Units are in
// the names; fields after "extensions" are missing in the frames of older senders, and are then
// zero.
namespace kestrel::mavlink {

/// LANDING_TARGET (149): a target on the ground, by direction and, when position_valid, by place.
struct LandingTarget {
  std::uint64_t time_us = 0;
  float angle_x_rad = 0;
  float angle_y_rad = 0;
  float distance_m = 0;
  float size_x_rad = 0;
  float size_y_rad = 0;
  std::uint8_t target_num = 0;
  std::uint8_t frame = 0;
  // extensions
  float x_m = 0;
  float y_m = 0;
  float z_m = 0;
  std::array<float, 4> q{};
  std::uint8_t type = 0;
  std::uint8_t position_valid = 0;
};

/// ODOMETRY (331): pose and twist with their covariances (upper triangles, row by row).
struct Odometry {
  std::uint64_t time_us = 0;
  float x_m = 0;
  float y_m = 0;
  float z_m = 0;
  std::array<float, 4> q{};
  float vx_m_s = 0;
  float vy_m_s = 0;
  float vz_m_s = 0;
  float roll_rate_rad_s = 0;
  float pitch_rate_rad_s = 0;
  float yaw_rate_rad_s = 0;
  std::array<float, 21> pose_covariance{};
  std::array<float, 21> velocity_covariance{};
  std::uint8_t frame_id = 0;
  std::uint8_t child_frame_id = 0;
  // extensions
  std::uint8_t reset_counter = 0;
  std::uint8_t estimator_type = 0;
  std::int8_t quality = 0;
};

/// VISION_POSITION_ESTIMATE (102): a pose measured by a camera, for the estimator of the
/// autopilot.
struct VisionPosition {
  std::uint64_t time_us = 0;
  float x_m = 0;
  float y_m = 0;
  float z_m = 0;
  float roll_rad = 0;
  float pitch_rad = 0;
  float yaw_rad = 0;
  // extensions
  std::array<float, 21> covariance{};
  std::uint8_t reset_counter = 0;
};

/// VISION_SPEED_ESTIMATE (103): a velocity measured by a camera, north, east, down.
struct VisionSpeed {
  std::uint64_t time_us = 0;
  float vx_m_s = 0;
  float vy_m_s = 0;
  float vz_m_s = 0;
  // extensions
  std::array<float, 9> covariance{};
  std::uint8_t reset_counter = 0;
};

}  // namespace kestrel::mavlink

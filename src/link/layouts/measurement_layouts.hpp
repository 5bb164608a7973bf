#pragma once

#include "kestrel/link/measurement_messages.hpp"

#include "layout.hpp"

namespace kestrel::mavlink {

template <>
struct Layout<LandingTarget> {
  static constexpr std::string_view kName = "LANDING_TARGET";
  static constexpr std::uint32_t kId = 149;
  static constexpr std::uint8_t kCrcExtra = 200;
  static constexpr std::size_t kLength = 30;
  static constexpr std::size_t kLongest = 60;
  static constexpr auto kFields = std::make_tuple(
      field("time_usec", &LandingTarget::time_us), field("angle_x", &LandingTarget::angle_x_rad),
      field("angle_y", &LandingTarget::angle_y_rad), field("distance", &LandingTarget::distance_m),
      field("size_x", &LandingTarget::size_x_rad), field("size_y", &LandingTarget::size_y_rad),
      field("target_num", &LandingTarget::target_num), field("frame", &LandingTarget::frame));
  static constexpr auto kExtensions = std::make_tuple(
      field("x", &LandingTarget::x_m), field("y", &LandingTarget::y_m),
      field("z", &LandingTarget::z_m), field("q", &LandingTarget::q),
      field("type", &LandingTarget::type), field("position_valid", &LandingTarget::position_valid));
};
static_assert(as_published<LandingTarget>());

template <>
struct Layout<Odometry> {
  static constexpr std::string_view kName = "ODOMETRY";
  static constexpr std::uint32_t kId = 331;
  static constexpr std::uint8_t kCrcExtra = 91;
  static constexpr std::size_t kLength = 230;
  static constexpr std::size_t kLongest = 233;
  static constexpr auto kFields = std::make_tuple(
      field("time_usec", &Odometry::time_us), field("x", &Odometry::x_m),
      field("y", &Odometry::y_m), field("z", &Odometry::z_m), field("q", &Odometry::q),
      field("vx", &Odometry::vx_m_s), field("vy", &Odometry::vy_m_s),
      field("vz", &Odometry::vz_m_s), field("rollspeed", &Odometry::roll_rate_rad_s),
      field("pitchspeed", &Odometry::pitch_rate_rad_s),
      field("yawspeed", &Odometry::yaw_rate_rad_s),
      field("pose_covariance", &Odometry::pose_covariance),
      field("velocity_covariance", &Odometry::velocity_covariance),
      field("frame_id", &Odometry::frame_id), field("child_frame_id", &Odometry::child_frame_id));
  static constexpr auto kExtensions = std::make_tuple(
      field("reset_counter", &Odometry::reset_counter),
      field("estimator_type", &Odometry::estimator_type), field("quality", &Odometry::quality));
};
static_assert(as_published<Odometry>());

template <>
struct Layout<VisionPosition> {
  static constexpr std::string_view kName = "VISION_POSITION_ESTIMATE";
  static constexpr std::uint32_t kId = 102;
  static constexpr std::uint8_t kCrcExtra = 158;
  static constexpr std::size_t kLength = 32;
  static constexpr std::size_t kLongest = 117;
  static constexpr auto kFields = std::make_tuple(
      field("usec", &VisionPosition::time_us), field("x", &VisionPosition::x_m),
      field("y", &VisionPosition::y_m), field("z", &VisionPosition::z_m),
      field("roll", &VisionPosition::roll_rad), field("pitch", &VisionPosition::pitch_rad),
      field("yaw", &VisionPosition::yaw_rad));
  static constexpr auto kExtensions =
      std::make_tuple(field("covariance", &VisionPosition::covariance),
                      field("reset_counter", &VisionPosition::reset_counter));
};
static_assert(as_published<VisionPosition>());

template <>
struct Layout<VisionSpeed> {
  static constexpr std::string_view kName = "VISION_SPEED_ESTIMATE";
  static constexpr std::uint32_t kId = 103;
  static constexpr std::uint8_t kCrcExtra = 208;
  static constexpr std::size_t kLength = 20;
  static constexpr std::size_t kLongest = 57;
  static constexpr auto kFields =
      std::make_tuple(field("usec", &VisionSpeed::time_us), field("x", &VisionSpeed::vx_m_s),
                      field("y", &VisionSpeed::vy_m_s), field("z", &VisionSpeed::vz_m_s));
  static constexpr auto kExtensions =
      std::make_tuple(field("covariance", &VisionSpeed::covariance),
                      field("reset_counter", &VisionSpeed::reset_counter));
};
static_assert(as_published<VisionSpeed>());

}  // namespace kestrel::mavlink

#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/sim/onboard_camera.hpp"
#include "kestrel/sim/scene.hpp"
#include "kestrel/sim/vehicle.hpp"
#include "kestrel/vehicle/velocity_command.hpp"
#include "kestrel/vision/frame.hpp"

namespace kestrel {

/// 640x480, 600 px focal length (56 by 44 degrees), the optical axis through the centre of the
/// picture: (319.5, 239.5) as pixel centres count.
Camera default_camera();

/// A camera at the helicopter's origin that looks ahead: x of Camera to the right, y down.
Mount forward_mount();

/// What flies where, and how it looks.
struct WorldOptions {
  Camera camera = default_camera();
  Mount body_from_camera = forward_mount();
  VehicleOptions vehicle = HelicopterOptions{};
  HelicopterState start = default_start();
  double rate_hz = 30;
  std::optional<std::int64_t> frames = 1200;  // empty: without end
  ImagingOptions imaging;
  std::uint64_t seed = 1;  // of noise, drops, wind and sensors
  /// Without a command for this long the helicopter hovers, as a flight controller does by itself.
  double command_timeout_s = 0.5;

  /// 9 m south of the target, 1.5 m east and 1.0 m below, at rest, looking north.
  static HelicopterState default_start();

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// The helicopter in the computer, in lockstep: each frame shows the scene from where the commands
/// up to it have brought the camera. Poses are composed here: nothing is shared with the maths of
/// the servo loop.
class World final : public FrameSource, public CommandSink {
 public:
  /// Throws std::invalid_argument for a scene or options that do not check.
  World(const Scene& scene, const WorldOptions& options);

  /// Flies on for one period with the commands sent (not before the first frame) and looks; for
  /// more than one after a frame that was dropped. Frame k is stamped k / rate_hz and carries the
  /// attitude that the flight computer reports. Empty after the last frame, and the
  /// helicopter stays where that showed it.
  std::optional<Frame> next() override;
  const std::vector<std::string>& skipped() const override { return skipped_; }
  std::optional<std::int64_t> frame_count() const override { return options_.frames; }

  /// Obeyed from latency_s after the instant of the last frame on, whatever stamp_s says. A command
  /// that is not finite is counted as a failure and obeyed as hover.
  void send(const VelocityCommand& command, double stamp_s) noexcept override;
  long failures() const override { return failures_; }

  /// The truth at the instant of the last frame (before the first: the start).
  const TrueMotion& motion() const { return vehicle_.motion(); }
  /// The velocity (NED) that the flight computer reports at that instant.
  Eigen::Vector3d measured_velocity_m_s() const { return vehicle_.measured_velocity_m_s(); }
  Transform<frame::World, frame::Camera> world_from_camera() const;
  TargetPose camera_from_target() const;
  /// The target's place at that instant.
  Transform<frame::World, frame::Target> world_from_target() const;

 private:
  /// A command and when the helicopter gets it.
  struct Pending {
    double at_s = 0;
    VelocityCommand command;
  };

  double stamp_s(std::int64_t frame) const { return double(frame) / options_.rate_hz; }
  double now_s() const { return stamp_s(std::max<std::int64_t>(next_frame_ - 1, 0)); }
  void fly_one_period();
  void fly(double from_s, double duration_s);
  Frame look();

  WorldOptions options_;
  OnboardCamera camera_;
  TexturedPlane target_;  // without its picture
  Vehicle vehicle_;
  std::int64_t next_frame_ = 0;
  std::deque<Pending> pending_;
  VelocityCommand command_;
  double command_stamp_s_ = 0;  // when it was obeyed first
  long failures_ = 0;
  std::vector<std::string> skipped_;
};

}  // namespace kestrel

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/sim/helicopter.hpp"
#include "kestrel/sim/render.hpp"
#include "kestrel/sim/scene.hpp"
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
  HelicopterOptions helicopter;
  HelicopterState start = default_start();
  double rate_hz = 30;
  std::optional<std::int64_t> frames = 1200;  // empty: without end
  double noise_grey = 0;                      // sensor noise, standard deviation
  std::uint64_t seed = 1;                     // of the noise
  /// Without a command for this long the helicopter hovers, as a flight controller does by itself.
  double command_timeout_s = 0.5;
  /// The target whose pose camera_from_target() tells.
  Transform<frame::World, frame::Target> world_from_target = world_from_wall();

  /// 9 m south of the target, 1.5 m east and 1.0 m below, at rest, looking north.
  static HelicopterState default_start();

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// The helicopter in the computer, in lockstep: each frame shows the scene from where the commands
/// up to it have brought the camera. Poses are composed here, never twists: nothing is shared with
/// the maths of the servo loop.
class World final : public FrameSource, public CommandSink {
 public:
  /// Throws std::invalid_argument for a scene or options that do not check.
  World(const Scene& scene, const WorldOptions& options);

  /// Flies on for one period with the command last sent (not before the first frame) and looks.
  /// Frame k is stamped k / rate_hz and carries the true attitude. Empty after the last frame, and
  /// the helicopter stays where that showed it.
  std::optional<Frame> next() override;
  const std::vector<std::string>& skipped() const override { return skipped_; }
  std::optional<std::int64_t> frame_count() const override { return options_.frames; }

  /// Taken as arriving at the instant of the last frame, whatever stamp_s says. A command that is
  /// not finite is counted as a failure and obeyed as hover.
  void send(const VelocityCommand& command, double stamp_s) noexcept override;
  long failures() const override { return failures_; }

  /// The truth at the instant of the last frame (before the first: the start).
  const HelicopterState& state() const { return state_; }
  Transform<frame::World, frame::Camera> world_from_camera() const;
  TargetPose camera_from_target() const;

 private:
  double stamp_s(std::int64_t frame) const { return double(frame) / options_.rate_hz; }
  void fly_one_period();

  WorldOptions options_;
  Renderer renderer_;
  HelicopterState state_;
  std::int64_t next_frame_ = 0;
  VelocityCommand command_;
  double command_stamp_s_ = 0;
  long failures_ = 0;
  std::vector<std::string> skipped_;
};

}  // namespace kestrel

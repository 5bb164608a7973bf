#include "kestrel/sim/world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace kestrel {
namespace {

bool is_finite(const HelicopterState& s) {
  return s.position_m.allFinite() && s.velocity_m_s.allFinite() && std::isfinite(s.roll) &&
         std::isfinite(s.pitch) && std::isfinite(s.yaw) && std::isfinite(s.yaw_rate_rad_s);
}

const WorldOptions& checked(const WorldOptions& options) {
  options.check();
  return options;
}

}  // namespace

Camera default_camera() {
  CameraParameters p;
  p.px = 600;
  p.py = 600;
  p.u0 = 319.5;
  p.v0 = 239.5;
  p.width = 640;
  p.height = 480;
  return Camera(p);
}

Mount forward_mount() {
  Mount mount;
  mount.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return mount;
}

HelicopterState WorldOptions::default_start() {
  HelicopterState state;
  state.position_m << -9, 1.5, 1.0;
  return state;
}

void WorldOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  kestrel::check(vehicle);
  imaging.check();
  require(rotation_defect(body_from_camera.rotation) < 1e-5,
          "body_from_camera: must be a rotation");
  require(body_from_camera.translation.allFinite(), "body_from_camera: must be finite");
  require(is_finite(start), "start: must be finite");
  require(std::isfinite(rate_hz) && rate_hz > 0, "rate_hz: must be positive");
  require(frames.value_or(0) >= 0, "frames: must not be negative");
  require(command_timeout_s > 0, "command_timeout_s: must be positive");
}

World::World(const Scene& scene, const WorldOptions& options)
    : options_(checked(options)),
      camera_(scene, {options.camera, options.body_from_camera, options.imaging, options.seed}),
      vehicle_(options.vehicle, options.start, options.seed) {
  if (scene.planes.empty())
    return;  // nothing to look for: the target counts as at the wall's place
  target_ = scene.target_plane();
  target_.texture.release();
}

std::optional<Frame> World::next() {
  for (;;) {
    if (options_.frames && next_frame_ >= *options_.frames) return std::nullopt;
    if (next_frame_ > 0) fly_one_period();
    ++next_frame_;
    if (!camera_.drops(next_frame_ - 1)) return look();
  }
}

Frame World::look() {
  Frame frame = camera_.look(vehicle_.motion(), next_frame_ - 1, now_s());
  frame.attitude = vehicle_.measured_attitude();
  return frame;
}

void World::fly_one_period() {
  const double start_s = stamp_s(next_frame_ - 1);
  const double until_s = stamp_s(next_frame_);
  double from_s = start_s;
  while (!pending_.empty() && pending_.front().at_s < until_s) {
    const Pending arrived = pending_.front();
    pending_.pop_front();
    if (arrived.at_s > from_s) {
      fly(from_s, arrived.at_s - from_s);
      from_s = arrived.at_s;
    }
    command_ = arrived.command;
    command_stamp_s_ = arrived.at_s;
  }
  fly(from_s, from_s > start_s ? until_s - from_s : 1 / options_.rate_hz);
}

/// The flight controller looks whether a command is too old when a stretch begins: at each frame,
/// and at each command.
void World::fly(double from_s, double duration_s) {
  const bool fresh = from_s - command_stamp_s_ < options_.command_timeout_s;
  vehicle_.advance(fresh ? command_ : VelocityCommand::hover(), duration_s);
}

void World::send(const VelocityCommand& command, double /*stamp_s*/) noexcept {
  const bool finite = command.vector().allFinite();
  if (!finite) ++failures_;
  pending_.push_back(
      {now_s() + options_.imaging.latency_s, finite ? command : VelocityCommand::hover()});
}

Transform<frame::World, frame::Camera> World::world_from_camera() const {
  return vehicle_.motion().world_from_body * options_.body_from_camera;
}

Transform<frame::World, frame::Target> World::world_from_target() const {
  return pose(target_, now_s());
}

TargetPose World::camera_from_target() const {
  return world_from_camera().inverse() * world_from_target();
}

}  // namespace kestrel

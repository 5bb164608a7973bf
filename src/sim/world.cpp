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
  helicopter.check();
  RenderOptions{noise_grey, seed, 0}.check();
  require(rotation_defect(body_from_camera.rotation) < 1e-5,
          "body_from_camera: must be a rotation");
  require(body_from_camera.translation.allFinite(), "body_from_camera: must be finite");
  require(is_finite(start), "start: must be finite");
  require(std::isfinite(rate_hz) && rate_hz > 0, "rate_hz: must be positive");
  require(frames.value_or(0) >= 0, "frames: must not be negative");
  require(command_timeout_s > 0, "command_timeout_s: must be positive");
  require(rotation_defect(world_from_target.rotation) < 1e-5 &&
              world_from_target.translation.allFinite(),
          "world_from_target: must be a pose");
}

World::World(const Scene& scene, const WorldOptions& options)
    : options_(checked(options)), renderer_(scene, options.camera), state_(options.start) {}

std::optional<Frame> World::next() {
  if (options_.frames && next_frame_ >= *options_.frames) return std::nullopt;
  if (next_frame_ > 0) fly_one_period();
  Frame frame;
  frame.index = next_frame_;
  frame.stamp_s = stamp_s(next_frame_);
  frame.gray =
      renderer_.view(world_from_camera(), {options_.noise_grey, options_.seed, next_frame_});
  frame.attitude = attitude(state_);
  ++next_frame_;
  return frame;
}

void World::fly_one_period() {
  const double age_s = stamp_s(next_frame_ - 1) - command_stamp_s_;
  const bool fresh = age_s < options_.command_timeout_s;
  const VelocityCommand obeyed = fresh ? command_ : VelocityCommand::hover();
  state_ = advanced(state_, obeyed, 1 / options_.rate_hz, options_.helicopter);
}

void World::send(const VelocityCommand& command, double /*stamp_s*/) noexcept {
  const bool finite = command.vector().allFinite();
  if (!finite) ++failures_;
  command_ = finite ? command : VelocityCommand::hover();
  command_stamp_s_ = stamp_s(std::max<std::int64_t>(next_frame_ - 1, 0));
}

Transform<frame::World, frame::Camera> World::world_from_camera() const {
  return pose(state_) * options_.body_from_camera;
}

TargetPose World::camera_from_target() const {
  return world_from_camera().inverse() * options_.world_from_target;
}

}  // namespace kestrel

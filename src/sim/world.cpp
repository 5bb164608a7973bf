#include "kestrel/sim/world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "random.hpp"

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

void ImagingOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  RenderOptions render;
  render.noise_grey = noise_grey;
  render.vignetting = vignetting;
  render.check();
  shutter.check();
  vibration.check();
  require(gain_drift >= 0 && gain_drift < 1, "gain_drift: must be within [0, 1)");
  require(std::isfinite(gain_period_s) && gain_period_s > 0, "gain_period_s: must be positive");
  require(std::isfinite(latency_s) && latency_s >= 0, "latency_s: must not be negative");
  require(drop_share >= 0 && drop_share < 1, "drop_share: must be within [0, 1)");
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
      renderer_(scene, options.camera),
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
    if (!is_dropped(next_frame_ - 1)) return look();
  }
}

Frame World::look() {
  const ImagingOptions& imaging = options_.imaging;
  Frame frame;
  frame.index = next_frame_ - 1;
  frame.stamp_s = now_s();
  RenderOptions render;
  render.noise_grey = imaging.noise_grey;
  render.seed = options_.seed;
  render.frame = frame.index;
  render.vignetting = imaging.vignetting;
  render.gain = 1 + imaging.gain_drift * std::sin(2 * M_PI * frame.stamp_s / imaging.gain_period_s);
  frame.gray =
      renderer_.expose(shot({vehicle_.motion(), options_.body_from_camera, imaging.vibration},
                            frame.stamp_s, options_.camera, imaging.shutter),
                       render);
  frame.attitude = vehicle_.measured_attitude();
  return frame;
}

bool World::is_dropped(std::int64_t frame) const {
  if (options_.imaging.drop_share == 0 || frame == 0) return false;  // the first frame is there
  sim_detail::RandomStream random(sim_detail::derived_seed(~options_.seed, std::uint64_t(frame)));
  return random.uniform(0, 1) < options_.imaging.drop_share;
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

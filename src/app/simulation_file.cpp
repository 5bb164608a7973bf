#include "simulation_file.hpp"

#include <cmath>
#include <functional>
#include <stdexcept>

#include "kestrel/io/gray_image.hpp"
#include "kestrel/sim/texture.hpp"

namespace kestrel::app {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kPosterPxPerM = 400;  // finer than a 600 px camera sees from 1.5 m

HelicopterState read_start(const Section& section, HelicopterState start) {
  if (section.has("position_ned_m")) {
    const auto p = section.numbers("position_ned_m", 3);
    start.position_m = {p[0], p[1], p[2]};
  }
  start.yaw = section.number("heading_deg", start.yaw / kDegree) * kDegree;
  return start;
}

HoverGoal read_pass(const Section& section, HoverGoal goal) {
  goal.position_m = section.number("position_m", goal.position_m);
  goal.heading_rad = section.number("heading_deg", goal.heading_rad / kDegree) * kDegree;
  goal.hold_s = section.number("hold_s", goal.hold_s);
  goal.lost_s = section.number("lost_s", goal.lost_s);
  goal.collision_m = section.number("collision_m", goal.collision_m);
  return goal;
}

HelicopterOptions read_helicopter(const Section& section, HelicopterOptions h) {
  h.tau_v_s = section.number("velocity_time_constant_s", h.tau_v_s);
  h.tau_a_s = section.number("tilt_time_constant_s", h.tau_a_s);
  h.tau_z_s = section.number("vertical_time_constant_s", h.tau_z_s);
  h.tau_r_s = section.number("yaw_time_constant_s", h.tau_r_s);
  h.max_tilt_rad = section.number("max_tilt_deg", h.max_tilt_rad / kDegree) * kDegree;
  return h;
}

/// Runs a check of options; what it finds becomes an error of the section.
void checked(const Section& section, const std::function<void()>& check) {
  try {
    check();
  } catch (const std::invalid_argument& error) {
    section.fail("", error.what());
  }
}

}  // namespace

Simulation read_simulation(const Section& section) {
  Simulation s;
  s.world.rate_hz = section.number("rate_hz", s.world.rate_hz);
  const double duration_s = section.number("duration_s", 60);
  if (!(duration_s > 0)) section.fail("duration_s", "must be positive");
  s.world.frames = std::int64_t(std::ceil(duration_s * s.world.rate_hz));
  s.world.noise_grey = section.number("noise_grey", 2);
  const std::int64_t seed = section.integer("seed", 1);
  if (seed < 0) section.fail("seed", "must not be negative");
  s.world.seed = std::uint64_t(seed);
  s.world.command_timeout_s = section.number("command_timeout_s", s.world.command_timeout_s);
  if (const auto start = section.child_if("start")) {
    s.world.start = read_start(*start, s.world.start);
  }
  if (const auto pass = section.child_if("pass")) s.goal = read_pass(*pass, s.goal);
  if (const auto helicopter = section.child_if("helicopter")) {
    s.world.helicopter = read_helicopter(*helicopter, s.world.helicopter);
  }
  if (section.has("texture")) s.texture = section.path("texture");
  checked(section, [&] {
    s.world.check();
    s.goal.check();
  });
  return s;
}

Scene scene_of(const Simulation& simulation) {
  const WallOptions& wall = simulation.wall;
  if (simulation.texture.empty()) {
    return wall_scene(poster(int(wall.poster_width_m * kPosterPxPerM),
                             int(wall.poster_height_m * kPosterPxPerM), wall.seed),
                      wall);
  }
  return wall_scene(load_gray(simulation.texture), wall);
}

}  // namespace kestrel::app

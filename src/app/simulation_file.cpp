#include "simulation_file.hpp"

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

namespace kestrel::app {
namespace {

constexpr double kDegree = M_PI / 180;

HelicopterState read_start(const Section& section, HelicopterState start) {
  if (section.has("position_ned_m")) {
    const auto p = section.numbers("position_ned_m", 3);
    start.position_m = {p[0], p[1], p[2]};
  }
  start.yaw = section.number("heading_deg", start.yaw / kDegree) * kDegree;
  return start;
}

Scatter read_scatter(const Section& section) {
  Scatter s;
  if (section.has("scatter_ned_m")) {
    const auto p = section.numbers("scatter_ned_m", 3);
    s.position_ned_m = {p[0], p[1], p[2]};
  }
  s.heading_rad = section.number("scatter_heading_deg", 0) * kDegree;
  if (s.position_ned_m.minCoeff() < 0) section.fail("scatter_ned_m", "must not be negative");
  if (s.heading_rad < 0) section.fail("scatter_heading_deg", "must not be negative");
  return s;
}

HoverGoal read_pass(const Section& section, HoverGoal goal) {
  goal.position_m = section.number("position_m", goal.position_m);
  goal.heading_rad = section.number("heading_deg", goal.heading_rad / kDegree) * kDegree;
  goal.hold_s = section.number("hold_s", goal.hold_s);
  goal.lost_s = section.number("lost_s", goal.lost_s);
  goal.collision_m = section.number("collision_m", goal.collision_m);
  return goal;
}

Eigen::Vector3d vector(const Section& section, const std::string& key, const Eigen::Vector3d& v) {
  if (!section.has(key)) return v;
  const auto n = section.numbers(key, 3);
  return {n[0], n[1], n[2]};
}

double degrees(const Section& section, const std::string& key, double otherwise_rad) {
  return section.number(key, otherwise_rad / kDegree) * kDegree;
}

HelicopterOptions read_loops(const Section& section, HelicopterOptions h) {
  h.tau_v_s = section.number("velocity_time_constant_s", h.tau_v_s);
  h.tau_a_s = section.number("tilt_time_constant_s", h.tau_a_s);
  h.tau_z_s = section.number("vertical_time_constant_s", h.tau_z_s);
  h.tau_r_s = section.number("yaw_time_constant_s", h.tau_r_s);
  h.max_tilt_rad = degrees(section, "max_tilt_deg", h.max_tilt_rad);
  return h;
}

RotorcraftSystem read_rigid(const Section& section, RotorcraftSystem s) {
  s.body.mass_kg = section.number("mass_kg", s.body.mass_kg);
  s.body.inertia_kg_m2 = vector(section, "inertia_kg_m2", s.body.inertia_kg_m2);
  s.body.rotor_radius_m = section.number("rotor_radius_m", s.body.rotor_radius_m);
  s.body.rotor_speed_rad_s = section.number("rotor_speed_rad_s", s.body.rotor_speed_rad_s);
  s.controller.max_tilt_rad = degrees(section, "max_tilt_deg", s.controller.max_tilt_rad);
  s.controller.velocity_p_per_s = section.number("velocity_p_per_s", s.controller.velocity_p_per_s);
  s.controller.velocity_i_per_s2 =
      section.number("velocity_i_per_s2", s.controller.velocity_i_per_s2);
  return s;
}

WindOptions read_wind(const Section& section, WindOptions w) {
  w.mean_ned_m_s = vector(section, "mean_ned_m_s", w.mean_ned_m_s);
  w.turbulence_m_s = section.number("turbulence_m_s", w.turbulence_m_s);
  w.altitude_m = section.number("altitude_m", w.altitude_m);
  w.gust_ned_m_s = vector(section, "gust_ned_m_s", w.gust_ned_m_s);
  w.gust_start_s = section.number("gust_start_s", w.gust_start_s);
  w.gust_duration_s = section.number("gust_duration_s", w.gust_duration_s);
  return w;
}

MotionSensorOptions read_sensors(const Section& section, MotionSensorOptions m) {
  m.attitude_bias_rad = degrees(section, "attitude_bias_deg", m.attitude_bias_rad);
  m.heading_bias_rad = degrees(section, "heading_bias_deg", m.heading_bias_rad);
  m.attitude_noise_rad = degrees(section, "attitude_noise_deg", m.attitude_noise_rad);
  m.velocity_noise_m_s = section.number("velocity_noise_m_s", m.velocity_noise_m_s);
  m.rate_noise_rad_s = degrees(section, "rate_noise_deg_s", m.rate_noise_rad_s);
  m.correlation_time_s = section.number("correlation_time_s", m.correlation_time_s);
  return m;
}

enum class Model { Loops, Rigid };

VehicleOptions read_vehicle(const Section& simulation) {
  const auto section = simulation.child_if("helicopter");
  const Model model =
      section ? section->choice<Model>("model", {{"loops", Model::Loops}, {"rigid", Model::Rigid}},
                                       Model::Loops)
              : Model::Loops;
  if (model == Model::Loops) {
    for (const char* key : {"wind", "sensors"}) {
      if (simulation.has(key)) {
        simulation.fail(key, "needs `helicopter: {model: rigid}`; the loops know no air");
      }
    }
    return section ? read_loops(*section, {}) : HelicopterOptions{};
  }
  RotorcraftSystem system = read_rigid(*section, {});
  if (const auto wind = simulation.child_if("wind")) system.wind = read_wind(*wind, {});
  if (const auto sensors = simulation.child_if("sensors"))
    system.sensor = read_sensors(*sensors, {});
  return system;
}

ImagingOptions read_imaging(const Section& section, ImagingOptions i) {
  i.vignetting = section.number("vignetting", i.vignetting);
  i.gain_drift = section.number("gain_drift", i.gain_drift);
  i.gain_period_s = section.number("gain_period_s", i.gain_period_s);
  i.shutter.exposure_s = section.number("exposure_s", i.shutter.exposure_s);
  i.shutter.readout_s = section.number("readout_s", i.shutter.readout_s);
  i.vibration.amplitude_rad =
      vector(section, "vibration_deg", i.vibration.amplitude_rad / kDegree) * kDegree;
  i.vibration.frequency_hz = section.number("rotor_hz", i.vibration.frequency_hz);
  i.latency_s = section.number("latency_s", i.latency_s);
  i.drop_share = section.number("drop_share", i.drop_share);
  return i;
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

HelicopterState scattered(HelicopterState start, const Scatter& scatter, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto within = [&](double size) {  // the same on every machine, unlike the library's
    return size * (double(random() >> 11) * 0x1p-52 - 1);
  };
  for (int i = 0; i < 3; ++i) start.position_m[i] += within(scatter.position_ned_m[i]);
  start.yaw += within(scatter.heading_rad);
  return start;
}

Simulation read_simulation(const Section& section) {
  Simulation s;
  s.world.rate_hz = section.number("rate_hz", s.world.rate_hz);
  const double duration_s = section.number("duration_s", 60);
  if (!(duration_s > 0)) section.fail("duration_s", "must be positive");
  s.world.frames = std::int64_t(std::ceil(duration_s * s.world.rate_hz));
  s.world.imaging.noise_grey = section.number("noise_grey", 2);
  const std::int64_t seed = section.integer("seed", 1);
  if (seed < 0) section.fail("seed", "must not be negative");
  s.world.seed = std::uint64_t(seed);
  s.world.command_timeout_s = section.number("command_timeout_s", s.world.command_timeout_s);
  if (const auto start = section.child_if("start")) {
    s.world.start = read_start(*start, s.world.start);
    s.scatter = read_scatter(*start);
  }
  if (const auto pass = section.child_if("pass")) s.goal = read_pass(*pass, s.goal);
  s.world.vehicle = read_vehicle(section);
  if (const auto imaging = section.child_if("imaging")) {
    s.world.imaging = read_imaging(*imaging, s.world.imaging);
  }
  s.scene = read_scene(section);
  checked(section, [&] {
    s.world.check();
    s.goal.check();
  });
  return s;
}

}  // namespace kestrel::app

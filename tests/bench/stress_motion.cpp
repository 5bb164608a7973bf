#include "bench/stress_motion.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel::test {
namespace {

constexpr double kDegree = M_PI / 180;

/// Half diagonal of a template as learned, px: jumps keep about this much of it in the image.
constexpr double kReach_px = 128;

StressMotion nominal() {
  StressMotion m;
  m.u = {{40, 170}, {8, 55}};
  m.v = {{22, 140}, {6, 48}};
  m.octaves = {{0.15, 200}};
  m.roll = {{10 * kDegree, 160}};
  m.tilt = {{12 * kDegree, 190}};
  return m;
}

StressMotion scale() {
  StressMotion m = nominal();
  m.u = {{12, 130}};
  m.v = {{8, 110}};
  m.octaves = {{1, 150}};
  m.roll = {{15 * kDegree, 210}};
  return m;
}

StressMotion rotation() {
  StressMotion m = nominal();
  m.u = {{30, 170}};
  m.roll = {{180 * kDegree, 300}};
  return m;
}

StressMotion tilt() {
  StressMotion m = nominal();
  m.octaves = {{0.1, 200}};
  m.tilt = {{60 * kDegree, 120}};
  m.tilt_turn_frames = 300;
  return m;
}

StressMotion shaken() {
  StressMotion m = nominal();
  m.u = {{85, 57}, {12, 21}};
  m.v = {{42, 47}, {6, 17}};
  return m;
}

StressMotion fast() {
  StressMotion m = nominal();
  m.u = {{85, 42}, {12, 19}};
  m.v = {{42, 35}, {6, 16}};
  return m;
}

/// A helicopter holds its place badly and vibrates: the rotor's 11.3 Hz and a blade's 17.9 Hz seen
/// at 30 frames/s (periods in frames).
StressMotion flight() {
  StressMotion m = nominal();
  m.u = {{55, 140}, {2.5, 30 / 11.3}, {1.2, 30 / 17.9}};
  m.v = {{30, 120}, {2, 30 / 11.3}, {1, 30 / 17.9}};
  m.octaves = {{0.3, 220}};
  m.roll = {{8 * kDegree, 130}, {0.4 * kDegree, 30 / 13.1}};
  m.tilt = {{18 * kDegree, 170}};
  return m;
}

/// The same in gusts: the vibration twice as large.
StressMotion gust() {
  StressMotion m = flight();
  m.u = {{65, 90}, {5, 30 / 11.3}, {2.5, 30 / 17.9}};
  m.v = {{40, 80}, {4, 30 / 11.3}, {2, 30 / 17.9}};
  m.octaves = {{0.5, 150}};
  m.roll = {{15 * kDegree, 110}, {0.8 * kDegree, 30 / 13.1}};
  m.tilt = {{35 * kDegree, 150}};
  return m;
}

StressMotion blackout() {
  StressMotion m = nominal();
  m.u = {{10, 90}};
  m.v = {{8, 80}};
  m.jump_frames = 30;
  return m;
}

void vary(Waves& waves, Random& random, bool has_free_phase) {
  for (Wave& wave : waves) {
    wave.amplitude *= random.uniform(0.8, 1) * (random.integer(0, 1) == 0 ? -1 : 1);
    wave.phase = random.uniform(-1, 1);
    if (!has_free_phase) wave.phase = 0;
  }
}

/// Where jump number n (from 1) leads: half to twice the size, any angle, the poster in view.
StressPose jumped(const std::string& name, int n) {
  Random random(name + " jump " + std::to_string(n));
  StressPose pose;
  pose.scale = std::exp2(random.uniform(-1, 1));
  const double reach = kReach_px * pose.scale;
  const double room_u = std::max(0., 319.5 - reach);
  const double room_v = std::max(0., 239.5 - reach);
  pose.centre.u += random.uniform(-room_u, room_u);
  pose.centre.v += random.uniform(-room_v, room_v);
  pose.roll = random.uniform(-M_PI, M_PI);
  const double tilt = random.uniform(0, 25 * kDegree);
  const double axis = random.uniform(0, 2 * M_PI);
  pose.tilt_x = tilt * std::cos(axis);
  pose.tilt_y = tilt * std::sin(axis);
  return pose;
}

}  // namespace

double Wave::at(double t_frames) const {
  const double turn = 2 * M_PI * t_frames / period_frames;
  return amplitude * (std::sin(turn + phase) - std::sin(phase));
}

double value(const Waves& waves, double t_frames) {
  double sum = 0;
  for (const Wave& wave : waves) sum += wave.at(t_frames);
  return sum;
}

TargetPose StressPose::camera_from_target() const {
  const double z = kDistance_m / scale;
  const Eigen::Vector3d at((centre.u - 319.5) / kFocal_px, (centre.v - 239.5) / kFocal_px, 1);
  return {rotation_from_vector({0, 0, roll}) * rotation_from_vector({tilt_x, tilt_y, 0}), z * at};
}

StressPose StressMotion::at(double t_frames) const {
  StressPose pose;
  if (jump_frames > 0) {
    const int jump = int(std::floor((t_frames + 0.5) / jump_frames));
    if (jump > 0) pose = jumped(jump_name, jump);
  }
  pose.centre.u += value(u, t_frames);
  pose.centre.v += value(v, t_frames);
  pose.scale *= std::exp2(value(octaves, t_frames));
  pose.roll += value(roll, t_frames);
  const double angle = value(tilt, t_frames);
  const double axis = tilt_axis + 2 * M_PI * t_frames / tilt_turn_frames;
  pose.tilt_x += angle * std::cos(axis);
  pose.tilt_y += angle * std::sin(axis);
  return pose;
}

StressMotion stress_motion(const std::string& cls, const std::string& name) {
  const std::map<std::string, StressMotion (*)()> laws = {
      {"nominal", nominal},      {"scale", scale},   {"rotation", rotation}, {"tilt", tilt},
      {"blur", shaken},          {"noise", nominal}, {"occlusion", nominal}, {"flight", flight},
      {"flight_window", flight}, {"gust", gust},     {"fast", fast},         {"blackout", blackout},
      {"small", nominal}};
  const auto law = laws.find(cls);
  if (law == laws.end()) throw std::invalid_argument("class: there is none named " + cls);
  Random random(name + " motion");
  StressMotion motion = law->second();
  vary(motion.u, random, true);
  vary(motion.v, random, true);
  vary(motion.octaves, random, false);  // so that the whole range is seen, in both directions
  vary(motion.roll, random, false);
  vary(motion.tilt, random, false);
  motion.tilt_axis = random.uniform(0, 2 * M_PI);
  motion.jump_name = name;
  return motion;
}

Transform<frame::Target, frame::Target> occluder_pose(double t_frames) {
  const double along = 1.1 * std::cos(2 * M_PI * t_frames / 120);
  const double direction = 2 * M_PI * t_frames / 330 + 0.3;
  const double turn = 2 * M_PI * t_frames / 200;
  Transform<frame::Target, frame::Target> pose;
  pose.rotation << std::cos(turn), -std::sin(turn), 0, std::sin(turn), std::cos(turn), 0, 0, 0, 1;
  pose.translation << along * std::cos(direction), along * std::sin(direction), 0;
  return pose;
}

}  // namespace kestrel::test

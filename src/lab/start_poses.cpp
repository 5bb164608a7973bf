#include "kestrel/lab/start_poses.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

namespace kestrel {
namespace {

constexpr double kPi = 3.14159265358979323846;

void demand(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("start poses: ") + what);
}

/// Uniform numbers that are the same with every standard library.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : engine_(seed) {}
  /// In [-half_width, half_width).
  double about_zero(double half_width) { return half_width * (2 * unit() - 1); }
  /// In [0, width).
  double upto(double width) { return width * unit(); }

 private:
  double unit() { return double(engine_() >> 11) * 0x1p-53; }
  std::mt19937_64 engine_;
};

StartPose drawn(Chance& chance, const StartBox& box) {
  StartPose pose;
  for (int i = 0; i < 3; ++i) pose.translation_m[i] = chance.about_zero(box.half_size_m[i]);
  const double direction = chance.upto(2 * kPi);
  const double tilt = chance.upto(box.largest_tilt_rad);
  const double roll = chance.about_zero(box.largest_roll_rad);
  const Eigen::Matrix3d R =
      rotation_from_vector(tilt * Eigen::Vector3d(std::cos(direction), std::sin(direction), 0)) *
      rotation_from_vector({0, 0, roll});
  pose.rotation_vector_rad = rotation_vector(R);
  return pose;
}

bool sees_all(const Scenario& scenario, const LabCamera& camera, const StartBox& box) {
  const std::vector<Feature> seen = seen_points(scenario.start, scenario.points_m);
  return std::all_of(seen.begin(), seen.end(), [&](const Feature& point) {
    const Pixel px = camera.to_pixel(point.at);
    return point.depth_m >= box.nearest_m && px.u >= box.margin_px && px.v >= box.margin_px &&
           px.u <= camera.width_px - box.margin_px && px.v <= camera.height_px - box.margin_px;
  });
}

}  // namespace

void StartBox::check() const {
  demand(half_size_m.allFinite() && half_size_m.minCoeff() >= 0, "half_size_m is negative");
  demand(largest_tilt_rad >= 0 && largest_tilt_rad <= kPi, "largest_tilt_rad must be 0 to pi");
  demand(largest_roll_rad >= 0 && largest_roll_rad <= kPi, "largest_roll_rad must be 0 to pi");
  demand(std::isfinite(margin_px), "margin_px must be finite");
  demand(std::isfinite(nearest_m) && nearest_m > 0, "nearest_m must be above 0");
  demand(tries >= 1, "tries must be at least 1");
}

Scenario started_from(const Scenario& scenario, const StartPose& start) {
  return scenario_from(scenario.name, scenario.points_m, scenario.goal,
                       {rotation_from_vector(start.rotation_vector_rad), start.translation_m});
}

std::vector<StartPose> start_poses(const Scenario& scenario, const LabCamera& camera,
                                   const StartBox& box, std::uint64_t seed, int count) {
  scenario.check();
  camera.check();
  box.check();
  demand(count >= 0, "count must not be negative");
  Chance chance(seed);
  std::vector<StartPose> poses;
  while (int(poses.size()) < count) {
    int tries = 0;
    StartPose pose;
    do {
      demand(tries++ < box.tries, "no start found that sees the target");
      pose = drawn(chance, box);
    } while (!sees_all(started_from(scenario, pose), camera, box));
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace kestrel

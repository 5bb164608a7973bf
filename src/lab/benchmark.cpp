#include "kestrel/lab/benchmark.hpp"

#include <cmath>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kGoalDepth_m = 0.75;

Eigen::Matrix3d turn_deg(double x, double y, double z) {
  return rotation_from_vector(Eigen::Vector3d(x, y, z) * kDegree);
}

TargetPose frontal_goal() { return {Eigen::Matrix3d::Identity(), {0, 0, kGoalDepth_m}}; }

Scenario from_goal(const char* name, const Eigen::Vector3d& t_m, const Eigen::Matrix3d& R) {
  return scenario_from(name, square_points(0.2), frontal_goal(), {R, t_m});
}

Scenario turned_about_axis(const char* name, double angle_deg) {
  return from_goal(name, {0, 0, 0}, turn_deg(0, 0, angle_deg));
}

/// The camera at this distance, its axis through the target's centre, tilted about its x axis:
/// oMc = (Rx, Rx (0, 0, -distance)).
TargetPose tilted(double angle_deg, double distance_m) {
  const Transform<frame::Target, frame::Camera> target_from_camera{
      turn_deg(angle_deg, 0, 0), turn_deg(angle_deg, 0, 0) * Eigen::Vector3d(0, 0, -distance_m)};
  return target_from_camera.inverse();
}

std::vector<Scenario> make_scenarios() {
  const std::vector<Eigen::Vector3d> square = square_points(0.2);
  const double s40 = std::sin(40 * kDegree);
  const double c40 = std::cos(40 * kDegree);
  return {
      {"S0_tutorial", square, frontal_goal(), {turn_deg(10, -10, 50), {.15, -.1, 1}}},
      from_goal("S1_small", {.05, -.04, -.10}, turn_deg(3, -2, 5)),
      turned_about_axis("S2_rz45", 45),
      turned_about_axis("S3_rz90", 90),
      turned_about_axis("S4_rz135", 135),
      turned_about_axis("S5_rz160", 160),
      turned_about_axis("S6_rz179", 179),
      turned_about_axis("S7_rz180", 180),
      from_goal("S8_trans", {.5, -.3, -.75}, turn_deg(0, 0, 0)),
      from_goal("S9_orbit40", kGoalDepth_m * Eigen::Vector3d(-s40, 0, 1 - c40), turn_deg(0, 40, 0)),
      from_goal("S10_rxry", {0, 0, 0}, turn_deg(12, -16, 0)),
      from_goal("S11_general", {-.15, .10, -.40}, turn_deg(-8, 6, 100)),
      {"S12_flip40", square, tilted(40, kGoalDepth_m), tilted(-40, kGoalDepth_m)},
      {"S13_oblique", square, tilted(40, kGoalDepth_m), tilted(10, 0.9)},
  };
}

}  // namespace

const std::vector<Scenario>& benchmark_scenarios() {
  static const std::vector<Scenario> scenarios = make_scenarios();
  return scenarios;
}

const std::vector<std::string>& benchmark_modifiers() {
  static const std::vector<std::string> modifiers{"kz0.5", "kz2",  "kz4", "f0.8", "f0.9",
                                                  "f1.1",  "f1.2", "d1",  "d2",   "d3",
                                                  "d3_l8", "n0.5", "n1",  "sat"};
  return modifiers;
}

std::vector<CameraExperiment> benchmark_experiments(int trace_every) {
  std::vector<CameraExperiment> all;
  for (const Scenario& scenario : benchmark_scenarios()) {
    std::vector<std::string> modifiers{""};
    if (scenario.name == "S0_tutorial" || scenario.name == "S3_rz90") {
      modifiers.insert(modifiers.end(), benchmark_modifiers().begin(), benchmark_modifiers().end());
    }
    for (const std::string& modifier : modifiers) {
      for (const Law law : all_laws()) {
        CameraSetup setup;
        setup.scenario = scenario;
        setup.law = benchmark_law(law);
        setup.conditions = modified({}, modifier);
        all.push_back({scenario.name, name(law), modifier, setup, trace_every});
      }
    }
  }
  return all;
}

}  // namespace kestrel

#include <algorithm>

#include "kestrel/io/mount_file.hpp"

#include "plan_parts.hpp"

namespace kestrel {
namespace {

constexpr const char* kAll = "all";

Eigen::Vector3d vector(const Section& section, const std::string& key) {
  const std::vector<double> n = section.numbers(key, 3);
  return {n[0], n[1], n[2]};
}

HelicopterScenario read_flight(const Section& section) {
  HelicopterScenario scenario;
  scenario.name = section.text("name");
  scenario.points_m = read_points(section);
  scenario.goal = read_pose<frame::Camera, frame::Target>(section.child("goal"));
  scenario.start_camera_m = vector(section, "start_camera_m");
  scenario.start_yaw_rad = section.number("start_yaw_deg", 0) * kPlanDegree;
  if (section.has("target_velocity_m_s")) {
    scenario.target_velocity_m_s = vector(section, "target_velocity_m_s");
  }
  if (section.has("body_from_camera")) {
    scenario.body_from_camera =
        read_pose<frame::Body, frame::Camera>(section.child("body_from_camera"));
  }
  if (section.has("world_from_target")) {
    const auto read = read_pose<frame::Camera, frame::Target>(section.child("world_from_target"));
    scenario.world_from_target = {read.rotation, read.translation};
  }
  or_fail(section, "", [&] { scenario.check(); });
  return scenario;
}

std::vector<HelicopterScenario> read_flights(const Section& section) {
  const std::vector<HelicopterScenario>& known = helicopter_scenarios();
  if (!section.has("scenarios")) return known;
  std::vector<HelicopterScenario> scenarios;
  for (const SectionItem& item : section.items("scenarios")) {
    if (item.keys) {
      scenarios.push_back(read_flight(*item.keys));
    } else if (item.word == kAll) {
      scenarios.insert(scenarios.end(), known.begin(), known.end());
    } else {
      const auto found = std::find_if(known.begin(), known.end(), [&](const auto& scenario) {
        return scenario.name == item.word;
      });
      if (found == known.end()) {
        section.fail("scenarios", "there is no scenario " + item.word + "; write H0 or H1");
      }
      scenarios.push_back(*found);
    }
  }
  return scenarios;
}

/// Those of the benchmark, each once, in its order.
std::vector<std::string> benchmark_labels() {
  std::vector<std::string> labels;
  for (const HelicopterExperiment& experiment : helicopter_benchmark()) {
    if (std::count(labels.begin(), labels.end(), experiment.law) == 0) {
      labels.push_back(experiment.law);
    }
  }
  return labels;
}

}  // namespace

PlannedHelicopter read_helicopter(const Section& section) {
  PlannedHelicopter planned;
  planned.scenarios = read_flights(section);
  if (section.has("laws")) planned.laws = section.words("laws");
  if (planned.laws.empty() || planned.laws == std::vector<std::string>{kAll}) {
    planned.laws = benchmark_labels();
  }
  for (const std::string& label : planned.laws) {
    or_fail(section, "laws", [&] { helicopter_law_labelled(label); });
  }
  if (section.has("modifiers")) planned.modifiers = section.words("modifiers");
  for (const std::string& words : planned.modifiers) {
    or_fail(section, "modifiers", [&] { modified(HelicopterConditions{}, words); });
  }
  return planned;
}

}  // namespace kestrel

#include "kestrel/lab/margins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace kestrel {
namespace {

void demand(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("margins: ") + what);
}

/// The start moved towards the goal to this share of its way and of its rotation.
Scenario near_goal(const Scenario& scenario, double share) {
  GoalFromCamera start = scenario.start_in_goal();
  start.translation *= share;
  start.rotation = rotation_from_vector(rotation_vector(start.rotation) * share);
  return scenario_from(scenario.name, scenario.points_m, scenario.goal, start);
}

/// Largest error of the middle and of the last third of a run: their ratio is free of how the run
/// starts, and the error oscillates in both.
bool keeps_small_errors(CameraSetup setup, const MarginOptions& options) {
  constexpr double kGone = 1e-6;  // of the first error: below it rounding rules
  constexpr double kLarge = 100;  // of the first error: grown until the loop is no longer linear
  constexpr double kStillNoGrowth = 1e-7;  // an error that stays, up to rounding, does not grow
  setup.scenario = near_goal(setup.scenario, options.offset_share);
  std::array<double, 3> largest{};
  double first = 0;
  bool answered = true;  // a law that refuses holds nothing
  const RunResult result = run_camera(setup, [&](const RunStep& step) {
    answered = answered && step.refusal == LawRefusal::None;
    const double e = step.error.norm();
    if (step.step == 0) first = e;
    double& third = largest[std::size_t(3 * (step.step / double(setup.conditions.steps)))];
    third = std::max(third, e);
  });
  if (!answered || result.steps < setup.conditions.steps) return false;  // or it flew away
  if (*std::max_element(largest.begin(), largest.end()) > kLarge * first) return false;
  return largest[2] <= kGone * first || largest[2] <= (1 + kStillNoGrowth) * largest[1];
}

}  // namespace

void MarginOptions::check() const {
  demand(smallest_gain_per_s > 0, "smallest_gain_per_s must be above 0");
  demand(largest_gain_per_s > smallest_gain_per_s && std::isfinite(largest_gain_per_s),
         "largest_gain_per_s must be above smallest_gain_per_s");
  demand(gain_tolerance > 1e-12, "gain_tolerance must be above 1e-12");
  demand(largest_delay_frames >= 0 && largest_delay_frames <= 100000,
         "largest_delay_frames must be 0 to 100000");
  demand(offset_share > 0 && offset_share <= 1, "offset_share must be above 0, 1 at most");
  demand(steps >= 3, "steps must be at least 3");
}

bool is_stable(const CameraSetup& setup, const MarginOptions& options) {
  options.check();
  CameraSetup quiet = setup;
  quiet.conditions.noise_px = 0;
  quiet.conditions.steps = options.steps;
  quiet.rules.settled_error = 0;
  quiet.rules.stops_out_of_view = false;
  if (options.stability == Stability::AtGoal) return keeps_small_errors(quiet, options);
  return run_camera(quiet, [](const RunStep&) {}).end == RunEnd::Converged;
}

std::optional<double> gain_margin(const CameraSetup& setup, const MarginOptions& options) {
  const auto is_stable_at = [&](double gain_per_s) {
    CameraSetup with_gain = setup;
    with_gain.conditions.gain_per_s = gain_per_s;
    return is_stable(with_gain, options);
  };
  double stable = options.smallest_gain_per_s;
  double unstable = options.largest_gain_per_s;
  if (!is_stable_at(stable)) return std::nullopt;
  if (is_stable_at(unstable)) return unstable;
  while (unstable > stable * (1 + options.gain_tolerance)) {
    const double between = std::sqrt(stable * unstable);
    (is_stable_at(between) ? stable : unstable) = between;
  }
  return stable;
}

std::optional<int> delay_margin(const CameraSetup& setup, const MarginOptions& options) {
  const auto is_stable_at = [&](int delay_frames) {
    CameraSetup with_delay = setup;
    with_delay.conditions.delay_frames = delay_frames;
    return is_stable(with_delay, options);
  };
  int stable = 0;
  int unstable = options.largest_delay_frames;
  if (!is_stable_at(stable)) return std::nullopt;
  if (is_stable_at(unstable)) return unstable;
  while (unstable - stable > 1) {
    const int between = stable + (unstable - stable) / 2;
    (is_stable_at(between) ? stable : unstable) = between;
  }
  return stable;
}

}  // namespace kestrel

#include "kestrel/lab/helicopter_margins.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/lab/helicopter_benchmark.hpp"

namespace kestrel {
namespace {

void demand(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("margins: ") + what);
}

constexpr double kGone = 1e-9;  // of the offset at the start

bool is_positive(double value) { return std::isfinite(value) && value > 0; }

/// To the right of the helicopter at its goal, NED.
Eigen::Vector3d lateral_axis(const HelicopterScenario& scenario) {
  return rotation_from_rpy(0, 0, goal_heading(scenario)).col(1);
}

/// The setup beside its goal, at rest, with nothing that is not linear for a small offset.
HelicopterSetup beside_goal(HelicopterSetup setup, const HelicopterMarginOptions& options) {
  HelicopterScenario& s = setup.scenario;
  const Eigen::Vector3d goal_m = (s.world_from_target * s.goal.inverse()).translation;
  s.start_yaw_rad = goal_heading(s);
  s.start_camera_m = goal_m + lateral_axis(s) * options.offset_m;
  HelicopterConditions& c = setup.conditions;
  c.limits.reset();
  c.loss.reset();
  c.noise_px = 0;
  c.duration_s =
      std::max(options.shortest_s, options.fewest_commands * c.period_frames * kHelicopterFrame_s);
  return setup;
}

}  // namespace

void HelicopterMarginOptions::check() const {
  demand(is_positive(offset_m), "offset_m must be above 0");
  demand(is_positive(low_per_s), "low_per_s must be above 0");
  demand(std::isfinite(high_per_s) && high_per_s > low_per_s, "high_per_s must be above low_per_s");
  demand(relative_tolerance >= 1e-9 && relative_tolerance < 1,
         "relative_tolerance must be 1e-9 or more and below 1");
  demand(is_positive(shortest_s), "shortest_s must be above 0");
  demand(fewest_commands >= 1, "fewest_commands must be 1 or more");
}

bool settles_laterally(const HelicopterSetup& wanted, double gain_per_s,
                       const HelicopterMarginOptions& options) {
  options.check();
  HelicopterSetup setup = beside_goal(wanted, options);
  setup.conditions.gain_per_s = gain_per_s;
  std::vector<double> offsets_m;
  const Eigen::Vector3d right = lateral_axis(setup.scenario);
  const RunResult result = run_helicopter(setup, [&](const HelicopterStep& step) {
    offsets_m.push_back(std::abs(step.position_error_m.dot(right)));
  });
  if (result.end == RunEnd::Diverged || result.end == RunEnd::Collision) return false;
  const auto quarter = std::ptrdiff_t(offsets_m.size() / 4);
  const auto last = offsets_m.end() - quarter;
  // What has died away altogether no longer shrinks: it is rounding.
  const double before_m =
      std::max(*std::max_element(last - quarter, last), kGone * options.offset_m);
  return *std::max_element(last, offsets_m.end()) < before_m;
}

std::optional<double> lateral_gain_limit(const HelicopterSetup& setup,
                                         const HelicopterMarginOptions& options) {
  options.check();
  double stable = options.low_per_s;
  double unstable = options.high_per_s;
  if (!settles_laterally(setup, stable, options)) return std::nullopt;
  if (settles_laterally(setup, unstable, options)) return std::nullopt;
  while (unstable - stable > options.relative_tolerance * stable) {
    const double middle = (stable + unstable) / 2;
    (settles_laterally(setup, middle, options) ? stable : unstable) = middle;
  }
  return (stable + unstable) / 2;
}

std::optional<int> lateral_delay_limit(const HelicopterSetup& wanted, int most_frames,
                                       const HelicopterMarginOptions& options) {
  HelicopterSetup setup = wanted;
  const double gain_per_s = setup.conditions.gain_per_s.value_or(setup.law.law.gain.at_zero_per_s);
  const auto settles = [&](int frames) {
    setup.conditions.delay_frames = frames;
    return settles_laterally(setup, gain_per_s, options);
  };
  if (!settles(0)) return std::nullopt;
  if (settles(most_frames)) return most_frames;
  int stable = 0;
  int unstable = most_frames;
  while (unstable - stable > 1) {
    const int middle = (stable + unstable) / 2;
    (settles(middle) ? stable : unstable) = middle;
  }
  return stable;
}

std::vector<GainLimitRow> gain_limit_table(const HelicopterMarginOptions& options) {
  HelicopterSetup setup =
      helicopter_experiment(helicopter_h0(), HelicopterVariant::Vp3, Law::Des).setup;
  std::vector<GainLimitRow> table;
  for (const auto& [period, delay] :
       {std::pair{1, 0}, {1, 1}, {1, 3}, {1, 6}, {28, 0}, {19, 19}, {28, 28}, {58, 58}}) {
    GainLimitRow row{period, delay, {}, {}};
    setup.conditions.period_frames = period;
    setup.conditions.delay_frames = delay;
    setup.conditions.predicted = false;
    row.limit_per_s = lateral_gain_limit(setup, options);
    setup.conditions.predicted = true;
    row.predicted_limit_per_s = lateral_gain_limit(setup, options);
    table.push_back(row);
  }
  return table;
}

}  // namespace kestrel

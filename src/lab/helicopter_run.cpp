#include "kestrel/lab/helicopter_run.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/lab/helicopter_sight.hpp"

#include "helicopter_pilot.hpp"

namespace kestrel {
namespace {

void demand(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("rules: ") + what);
}

bool is_positive(double value) { return std::isfinite(value) && value > 0; }

/// The setup with the gain of its conditions in its law.
HelicopterSetup with_gain(HelicopterSetup setup) {
  if (const std::optional<double> gain_per_s = setup.conditions.gain_per_s) {
    setup.law.law.gain = LawGain::constant(*gain_per_s);
    setup.law.heading_gain_per_s = *gain_per_s;
  }
  return setup;
}

/// At rest and level, the camera where the scenario says.
HelicopterState start_of(const HelicopterScenario& scenario) {
  HelicopterState state;
  state.yaw = scenario.start_yaw_rad;
  state.position_m = scenario.start_camera_m -
                     rotation_from_rpy(0, 0, state.yaw) * scenario.body_from_camera.translation;
  return state;
}

/// |s - s*| of the points as the level camera sees them; infinite when one is beside it.
double error_norm(const std::vector<Feature>& points, const std::vector<Feature>& desired) {
  double squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    squares += std::pow(points[i].at.x - desired[i].at.x, 2) +
               std::pow(points[i].at.y - desired[i].at.y, 2);
  }
  return std::sqrt(squares);
}

/// The true errors of a frame.
class Judge {
 public:
  explicit Judge(const HelicopterSetup& setup)
      : setup_(setup),
        desired_(seen_points(setup.scenario.goal, setup.scenario.points_m)),
        goal_heading_rad_(goal_heading(setup.scenario)),
        goal_m_((setup.scenario.world_from_target * setup.scenario.goal.inverse()).translation) {}

  HelicopterStep seen(HelicopterFrame frame) const {
    HelicopterStep step;
    step.position_error_m = frame.world_from_camera.translation - goal_m_ -
                            frame.time_s * setup_.scenario.target_velocity_m_s;
    step.heading_error_rad = wrap_angle(frame.state.yaw - goal_heading_rad_);
    const Eigen::Matrix3d R =
        level_camera(setup_, frame).rotation.transpose() * frame.world_from_camera.rotation;
    step.error_norm = error_norm(turned(frame.points, R), desired_);
    step.frame = std::move(frame);
    return step;
  }

  /// Why the run cannot go on from here.
  std::optional<RunEnd> stop(const HelicopterStep& step) const {
    const HelicopterRules& rules = setup_.rules;
    if (!(step.position_error_m.norm() < rules.diverged_m)) return RunEnd::Diverged;
    const std::vector<Feature>& points = step.frame.points;
    const auto near = [&](const Feature& f) { return !(f.depth_m > rules.collision_m); };
    if (std::any_of(points.begin(), points.end(), near)) return RunEnd::Collision;
    if (!std::isfinite(step.error_norm)) return RunEnd::Diverged;
    if (rules.stops_out_of_view && !in_view(points)) return RunEnd::OutOfView;
    return std::nullopt;
  }

  /// Takes the step once it is complete.
  void watch(const HelicopterStep& step) {
    const HelicopterState& s = step.frame.state;
    const double moving = std::hypot(s.velocity_m_s.norm(), s.yaw_rate_rad_s);
    const bool is_still =
        step.seen && step.refusal == LawRefusal::None &&
        std::max(moving, step.wanted.vector().norm()) < setup_.rules.still_threshold;
    if (!is_still) moved_s_ = step.frame.time_s;
  }

  RunEnd end(const HelicopterStep& step) const {
    const bool there = step.position_error_m.norm() <= setup_.rules.position_tolerance_m;
    const bool aligned = std::abs(step.heading_error_rad) < setup_.rules.heading_tolerance_rad;
    if (there && aligned) return RunEnd::Converged;
    if (there) return RunEnd::PositionOnly;
    if (aligned) return RunEnd::HeadingOnly;
    if (step.refusal != LawRefusal::None) return RunEnd::Refused;
    const bool has_stood = step.frame.time_s - moved_s_ >= setup_.rules.still_s;
    return has_stood ? RunEnd::LocalMinimum : RunEnd::TimedOut;
  }

 private:
  bool in_view(const std::vector<Feature>& points) const {
    const LabCamera& camera = setup_.camera;
    return std::all_of(points.begin(), points.end(), [&](const Feature& f) {
      const Pixel p = camera.to_pixel(f.at);
      return p.u >= 0 && p.u <= camera.width_px && p.v >= 0 && p.v <= camera.height_px;
    });
  }

  const HelicopterSetup& setup_;
  std::vector<Feature> desired_;
  double goal_heading_rad_;
  Eigen::Vector3d goal_m_;
  double moved_s_ = 0;  // when it last was not still
};

}  // namespace

void HelicopterRules::check() const {
  demand(is_positive(position_tolerance_m), "position_tolerance_m must be above 0");
  demand(is_positive(heading_tolerance_rad), "heading_tolerance_rad must be above 0");
  demand(std::isfinite(still_threshold) && still_threshold >= 0,
         "still_threshold must not be negative");
  demand(is_positive(still_s), "still_s must be above 0");
  demand(std::isfinite(collision_m) && collision_m >= 0, "collision_m must not be negative");
  demand(is_positive(diverged_m), "diverged_m must be above 0");
}

void HelicopterSetup::check() const {
  scenario.check();
  camera.check();
  law.check();
  conditions.check();
  rules.check();
}

RunResult run_helicopter(const HelicopterSetup& wanted,
                         const std::function<void(const HelicopterStep&)>& observe,
                         const LabClock& clock) {
  wanted.check();
  const HelicopterSetup setup = with_gain(wanted);
  Judge judge(setup);
  const int last = int(std::lround(setup.conditions.duration_s / kHelicopterFrame_s));
  HelicopterPilot pilot(setup, clock);
  HelicopterState state = start_of(setup.scenario);
  RunResult result;
  for (int k = 0; k <= last; ++k) {
    HelicopterStep step = judge.seen(frame_at(setup, k, state));
    const std::optional<RunEnd> stop = judge.stop(step);
    if (!stop && k < last) pilot.fly(step.frame);
    pilot.tell(step);
    judge.watch(step);
    result.end = stop.value_or(judge.end(step));
    result.refusal = step.refusal;
    if (stop && !(std::isfinite(step.error_norm) && step.position_error_m.allFinite())) break;
    observe(step);
    ++result.steps;
    if (stop) break;
    if (k < last) state = advanced(state, step.sent, kHelicopterFrame_s, setup.conditions.plant);
  }
  result.law_s = pilot.law_s();
  return result;
}

}  // namespace kestrel

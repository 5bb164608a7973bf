#include "kestrel/lab/camera_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "kestrel/lab/law_sight.hpp"

#include "law_timer.hpp"

namespace kestrel {
namespace {

void demand(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("rules: ") + what);
}

bool is_in(const LabCamera& camera, const Feature& point) {
  const Pixel px = camera.to_pixel(point.at);
  return px.u >= 0 && px.v >= 0 && px.u <= camera.width_px && px.v <= camera.height_px;
}

/// One run, step by step.
class CameraLoop {
 public:
  CameraLoop(const CameraSetup& setup, const LabClock& clock)
      : setup_(setup),
        timer_(clock),
        law_(setup.law),
        sight_(setup),
        centre_m_(centre_of(setup.scenario.points_m)),
        period_s_(1 / setup.conditions.rate_hz) {
    if (setup.conditions.gain_per_s) {
      law_.gain = LawGain::constant(*setup.conditions.gain_per_s);
    }
    step_.goal_from_camera = setup.scenario.start_in_goal();
  }

  RunResult run(const std::function<void(const RunStep&)>& observe) {
    RunResult result;
    for (int k = 0; k < setup_.conditions.steps; ++k) {
      if (!see(k)) return ended(result, RunEnd::Diverged);
      const std::optional<RunEnd> stop = stop_reason();
      if (!stop) steer();
      observe(step_);
      ++result.steps;
      if (stop) return ended(result, *stop);
      if (is_settled()) return ended(result, RunEnd::Converged);
      step_.goal_from_camera = moved(step_.goal_from_camera, step_.twist, period_s_);
    }
    return ended(result, last_end());
  }

 private:
  /// The truth at step k; false when it is not finite.
  bool see(int k) {
    motion_ = step_.twist.vector() * period_s_;
    step_.step = k;
    step_.time_s = k * period_s_;
    step_.camera_from_target = step_.goal_from_camera.inverse() * setup_.scenario.goal;
    step_.points = seen_points(step_.camera_from_target, setup_.scenario.points_m);
    step_.error = -sight_.reached();
    for (std::size_t i = 0; i < step_.points.size(); ++i) {
      const ImagePoint& at = step_.points[i].at;
      step_.error.segment<2>(Eigen::Index(2 * i)) += Eigen::Vector2d(at.x, at.y);
    }
    step_.twist = {};
    step_.refusal = LawRefusal::None;
    step_.saturated = false;
    step_.rank = 0;
    step_.singular_values.resize(0);
    error_ = step_.error.norm();
    return std::isfinite(error_) && step_.camera_from_target.translation.allFinite();
  }

  std::optional<RunEnd> stop_reason() const {
    const RunRules& rules = setup_.rules;
    for (const Feature& point : step_.points) {
      if (point.depth_m <= rules.collision_m) return RunEnd::Collision;
    }
    if ((step_.camera_from_target * centre_m_).norm() >= rules.diverged_m) return RunEnd::Diverged;
    if (!rules.stops_out_of_view) return std::nullopt;
    for (const Feature& point : step_.points) {
      if (!is_in(setup_.camera, point)) return RunEnd::OutOfView;
    }
    return std::nullopt;
  }

  void steer() {
    sight_.look(step_.points, step_.camera_from_target, motion_);
    LawAnswer answer = timer_.timed([&] { return control_law(sight_.told(), law_, state_); });
    const bool is_usable = answer.twist && answer.twist->vector().allFinite();
    if (is_usable) step_.twist = limited(*answer.twist);
    step_.refusal = answer.refusal;
    if (!is_usable && answer.refusal == LawRefusal::None) step_.refusal = LawRefusal::NotFinite;
    step_.rank = answer.rank;
    step_.condition = answer.condition;
    step_.smallest_singular_value = answer.smallest_singular_value;
    step_.singular_values = std::move(answer.singular_values);
    state_ = std::move(answer.next);
  }

  CameraTwist limited(const CameraTwist& twist) {
    if (!setup_.conditions.limits) return twist;
    const CameraLimits& limits = *setup_.conditions.limits;
    const double excess = std::max(twist.linear.cwiseAbs().maxCoeff() / limits.linear_m_s,
                                   twist.angular.cwiseAbs().maxCoeff() / limits.angular_rad_s);
    if (excess <= 1) return twist;
    step_.saturated = true;
    return {twist.linear / excess, twist.angular / excess};
  }

  bool is_settled() {
    settled_ = error_ < setup_.rules.settled_error ? settled_ + 1 : 0;
    return settled_ >= setup_.rules.settled_steps;
  }

  RunEnd last_end() const {
    if (error_ < setup_.rules.error_threshold) return RunEnd::Converged;
    if (step_.refusal != LawRefusal::None) return RunEnd::Refused;
    const bool is_still = step_.twist.vector().norm() < setup_.rules.still_threshold;
    return is_still ? RunEnd::LocalMinimum : RunEnd::TimedOut;
  }

  RunResult ended(RunResult result, RunEnd end) const {
    result.end = end;
    result.law_s = timer_.all_s();
    if (end == RunEnd::Refused) result.refusal = step_.refusal;
    return result;
  }

  const CameraSetup& setup_;
  LawTimer timer_;
  LawOptions law_;
  LawSight sight_;
  Eigen::Vector3d centre_m_;
  double period_s_;
  LawState state_{};
  RunStep step_{};
  Vector6d motion_ = Vector6d::Zero();  // since the step before
  double error_ = 0;
  int settled_ = 0;
};

}  // namespace

void RunRules::check() const {
  demand(error_threshold > 0, "error_threshold must be above 0");
  demand(still_threshold >= 0, "still_threshold must not be negative");
  demand(collision_m >= 0, "collision_m must not be negative");
  demand(diverged_m > 0, "diverged_m must be above 0");
  demand(pose_tolerance_share > 0, "pose_tolerance_share must be above 0");
  demand(pose_tolerance_rad > 0, "pose_tolerance_rad must be above 0");
  demand(settled_error >= 0, "settled_error must not be negative");
  demand(settled_error <= error_threshold, "settled_error must not exceed error_threshold");
  demand(settled_steps >= 1, "settled_steps must be at least 1");
}

void CameraSetup::check() const {
  scenario.check();
  camera.check();
  law.check();
  conditions.check();
  rules.check();
}

LawOptions benchmark_law(Law law) {
  LawOptions options;
  options.law = law;
  options.gain = LawGain::constant(1);
  options.max_condition = std::numeric_limits<double>::infinity();
  return options;
}

RunResult run_camera(const CameraSetup& setup, const std::function<void(const RunStep&)>& observe,
                     const LabClock& clock) {
  setup.check();
  return CameraLoop(setup, clock).run(observe);
}

}  // namespace kestrel

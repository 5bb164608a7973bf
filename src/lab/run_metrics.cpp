#include "kestrel/lab/run_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kestrel {
namespace {

/// Distance of p from the line through a and b, or from a when they are one.
double distance_from_line(const Pixel& p, const Pixel& a, const Pixel& b) {
  const double length = distance(a, b);
  if (length < 1e-9) return distance(p, a);
  return std::abs((b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u)) / length;
}

double border_margin(const LabCamera& camera, const Pixel& p) {
  return std::min({p.u, p.v, camera.width_px - p.u, camera.height_px - p.v});
}

/// Angle of a rotation, rad: well conditioned near 0 and pi, where acos of the trace is not.
double angle_of(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d axis(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return std::atan2(axis.norm(), R.trace() - 1);
}

double root_mean_square_of_last_third(const std::vector<double>& values) {
  const std::size_t begin = values.size() - values.size() / 3;
  double sum = 0;
  for (std::size_t i = begin; i < values.size(); ++i) sum += values[i] * values[i];
  return values.size() > begin ? std::sqrt(sum / double(values.size() - begin)) : 0;
}

/// The step after the last one that was no good; empty when that was the end.
std::optional<int> for_good_after(int last_bad, int steps) {
  if (last_bad + 1 >= steps) return std::nullopt;
  return last_bad + 1;
}

}  // namespace

RunMeter::RunMeter(const CameraSetup& setup)
    : camera_(setup.camera),
      rules_(setup.rules),
      period_s_(1 / setup.conditions.rate_hz),
      centre_m_(centre_of(setup.scenario.points_m)),
      goal_depth_m_((setup.scenario.goal * centre_m_).z()),
      goal_distance_m_((setup.scenario.goal * centre_m_).norm()) {
  for (const Feature& point : seen_points(setup.scenario.goal, setup.scenario.points_m)) {
    goal_px_.push_back(camera_.to_pixel(point.at));
  }
  const auto steps = std::size_t(setup.conditions.steps);
  position_errors_m_.reserve(steps);
  angle_errors_rad_.reserve(steps);
  sums_.smallest_margin_px = std::numeric_limits<double>::infinity();
}

void RunMeter::add(const RunStep& step) {
  add_error(step);
  add_image(step);
  add_camera(step);
  add_matrix(step);
  ++steps_;
}

void RunMeter::add_error(const RunStep& step) {
  const double e = step.error.norm();
  if (steps_ == 0) sums_.initial_error = e;
  sums_.final_error = e;
  sums_.iae_s += e * period_s_;
  sums_.ise_s += e * e * period_s_;
  sums_.itae_s2 += step.time_s * e * period_s_;
  if (e >= rules_.error_threshold) last_bad_error_ = steps_;
}

void RunMeter::add_image(const RunStep& step) {
  for (std::size_t i = 0; i < step.points.size(); ++i) {
    const Pixel px = camera_.to_pixel(step.points[i].at);
    if (steps_ == 0) {
      first_px_.push_back(px);
      last_px_.push_back(px);
    }
    image_path_px_ += distance(last_px_[i], px);
    last_px_[i] = px;
    sums_.image_deviation_px =
        std::max(sums_.image_deviation_px, distance_from_line(px, first_px_[i], goal_px_[i]));
    const double margin_px = border_margin(camera_, px);
    sums_.smallest_margin_px = std::min(sums_.smallest_margin_px, margin_px);
    if (margin_px < 0 && !sums_.first_out_of_view) sums_.first_out_of_view = steps_;
  }
}

void RunMeter::add_camera(const RunStep& step) {
  const GoalFromCamera& pose = step.goal_from_camera;
  const double way_m = pose.translation.norm();
  const double angle_rad = angle_of(pose.rotation);
  const double distance_m = (step.camera_from_target * centre_m_).norm();
  if (steps_ == 0) {
    first_way_m_ = way_m;
    first_distance_m_ = nearest_m_ = farthest_m_ = distance_m;
  } else {
    sums_.path_m += (pose.translation - last_position_m_).norm();
  }
  last_position_m_ = pose.translation;
  nearest_m_ = std::min(nearest_m_, distance_m);
  farthest_m_ = std::max(farthest_m_, distance_m);
  position_errors_m_.push_back(way_m);
  angle_errors_rad_.push_back(angle_rad);
  const bool is_there =
      way_m < rules_.pose_tolerance_share * goal_depth_m_ && angle_rad < rules_.pose_tolerance_rad;
  if (!is_there) last_bad_pose_ = steps_;
}

void RunMeter::add_matrix(const RunStep& step) {
  sums_.max_linear_m_s = std::max(sums_.max_linear_m_s, step.twist.linear.norm());
  sums_.max_angular_rad_s = std::max(sums_.max_angular_rad_s, step.twist.angular.norm());
  sums_.effort += step.twist.vector().norm() * period_s_;
  if (step.saturated) sums_.saturated_s += period_s_;
  if (step.rank == 0) return;
  if (!std::isfinite(step.condition)) is_singular_ = true;
  sums_.largest_condition = std::max(sums_.largest_condition.value_or(0), step.condition);
  sums_.smallest_singular_value =
      std::min(sums_.smallest_singular_value.value_or(step.smallest_singular_value),
               step.smallest_singular_value);
}

RunMetrics RunMeter::metrics() const {
  RunMetrics all = sums_;
  if (steps_ == 0) {
    all.smallest_margin_px = 0;
    return all;
  }
  all.k_error = for_good_after(last_bad_error_, steps_);
  all.k_pose = for_good_after(last_bad_pose_, steps_);
  double chords_px = 0;
  for (std::size_t i = 0; i < first_px_.size(); ++i) {
    chords_px += distance(first_px_[i], goal_px_[i]);
  }
  if (chords_px > 1e-9) all.image_ratio = image_path_px_ / chords_px;
  if (first_way_m_ > 1e-9) all.path_ratio = all.path_m / first_way_m_;
  all.retreat_m = farthest_m_ - std::max(first_distance_m_, goal_distance_m_);
  all.approach_m = std::min(first_distance_m_, goal_distance_m_) - nearest_m_;
  if (is_singular_) all.largest_condition.reset();
  all.final_position_m = position_errors_m_.back();
  all.final_angle_rad = angle_errors_rad_.back();
  all.steady_position_rms_m = root_mean_square_of_last_third(position_errors_m_);
  all.steady_angle_rms_rad = root_mean_square_of_last_third(angle_errors_rad_);
  return all;
}

std::vector<std::pair<std::string, std::optional<double>>> named(const RunMetrics& m,
                                                                 double rate_hz) {
  const auto step = [](const std::optional<int>& k) {
    return k ? std::optional<double>(*k) : std::nullopt;
  };
  const auto seconds = [&](const std::optional<int>& k) {
    return k ? std::optional<double>(*k / rate_hz) : std::nullopt;
  };
  return {{"k_error", step(m.k_error)},
          {"t_error_s", seconds(m.k_error)},
          {"k_pose", step(m.k_pose)},
          {"t_pose_s", seconds(m.k_pose)},
          {"initial_error", m.initial_error},
          {"final_error", m.final_error},
          {"iae_s", m.iae_s},
          {"ise_s", m.ise_s},
          {"itae_s2", m.itae_s2},
          {"image_ratio", m.image_ratio},
          {"image_deviation_px", m.image_deviation_px},
          {"path_m", m.path_m},
          {"path_ratio", m.path_ratio},
          {"retreat_m", m.retreat_m},
          {"approach_m", m.approach_m},
          {"max_linear_m_s", m.max_linear_m_s},
          {"max_angular_rad_s", m.max_angular_rad_s},
          {"saturated_s", m.saturated_s},
          {"effort", m.effort},
          {"smallest_margin_px", m.smallest_margin_px},
          {"first_out_of_view", step(m.first_out_of_view)},
          {"largest_condition", m.largest_condition},
          {"smallest_singular_value", m.smallest_singular_value},
          {"final_position_m", m.final_position_m},
          {"final_angle_rad", m.final_angle_rad},
          {"steady_position_rms_m", m.steady_position_rms_m},
          {"steady_angle_rms_rad", m.steady_angle_rms_rad}};
}

}  // namespace kestrel

#include "kestrel/lab/helicopter_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace kestrel {
namespace {

constexpr double kNoWay_m = 1e-9;  // starts nearer to the goal than this have no straight line

std::size_t steady_from(std::size_t count) { return count - count / 3; }

double root_mean_square(const std::vector<double>& values) {
  double squares = 0;
  const std::size_t from = steady_from(values.size());
  for (std::size_t i = from; i < values.size(); ++i) squares += values[i] * values[i];
  return from == values.size() ? 0 : std::sqrt(squares / double(values.size() - from));
}

/// Standard deviations of the four components in the steady third.
Eigen::Vector4d deviations(const std::vector<VelocityCommand>& commands) {
  const std::size_t from = steady_from(commands.size());
  if (from == commands.size()) return Eigen::Vector4d::Zero();
  const double count = double(commands.size() - from);
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  for (std::size_t i = from; i < commands.size(); ++i) mean += commands[i].vector() / count;
  Eigen::Vector4d squares = Eigen::Vector4d::Zero();
  for (std::size_t i = from; i < commands.size(); ++i) {
    squares += (commands[i].vector() - mean).cwiseAbs2() / count;
  }
  return squares.cwiseSqrt();
}

/// Time of the first frame after the last bad one; empty when the run ends with a bad one.
std::optional<double> settled_s(int last_bad, int steps) {
  if (last_bad + 1 >= steps) return std::nullopt;
  return (last_bad + 1) * kHelicopterFrame_s;
}

}  // namespace

HelicopterMeter::HelicopterMeter(const HelicopterSetup& setup)
    : camera_(setup.camera), rules_(setup.rules) {
  sums_.smallest_margin_px = std::numeric_limits<double>::infinity();
}

void HelicopterMeter::add(const HelicopterStep& step) {
  add_errors(step);
  add_image(step);
  add_command(step);
  add_matrix(step);
  ++steps_;
}

void HelicopterMeter::add_errors(const HelicopterStep& step) {
  const Eigen::Vector3d& at_m = step.position_error_m;
  if (steps_ == 0) {
    start_m_ = at_m;
  } else {
    sums_.path_m += (at_m - last_m_).norm();
  }
  last_m_ = at_m;
  const double position_m = at_m.norm();
  const double heading_rad = std::abs(step.heading_error_rad);
  if (!(position_m <= rules_.position_tolerance_m)) last_bad_position_ = steps_;
  if (!(heading_rad < rules_.heading_tolerance_rad)) last_bad_heading_ = steps_;
  positions_m_.push_back(position_m);
  headings_rad_.push_back(heading_rad);
  sums_.final_error = step.error_norm;
  sums_.iae_s += step.error_norm * kHelicopterFrame_s;
  sums_.ise_s += step.error_norm * step.error_norm * kHelicopterFrame_s;
  sums_.itae_s2 += step.frame.time_s * step.error_norm * kHelicopterFrame_s;
  sums_.position_iae_m_s += position_m * kHelicopterFrame_s;
  if (start_m_.norm() > kNoWay_m) {
    sums_.overshoot_m = std::max(sums_.overshoot_m, -at_m.dot(start_m_.normalized()));
  }
  const HelicopterState& s = step.frame.state;
  sums_.largest_tilt_rad = std::max({sums_.largest_tilt_rad, std::abs(s.roll), std::abs(s.pitch)});
}

void HelicopterMeter::add_image(const HelicopterStep& step) {
  double margin_px = std::numeric_limits<double>::infinity();
  for (const Feature& f : step.frame.points) {
    const Pixel p = camera_.to_pixel(f.at);
    margin_px = std::min({margin_px, p.u, camera_.width_px - p.u, p.v, camera_.height_px - p.v});
  }
  sums_.smallest_margin_px = std::min(sums_.smallest_margin_px, margin_px);
  if (margin_px < 0 && !sums_.first_out_of_view_s) sums_.first_out_of_view_s = step.frame.time_s;
}

void HelicopterMeter::add_command(const HelicopterStep& step) {
  const VelocityCommand& c = step.sent;
  const double speed_m_s = c.vector().head<3>().norm();
  const double turn_rad_s = std::abs(c.yaw_rate_rad_s);
  sums_.effort_m += speed_m_s * kHelicopterFrame_s;
  sums_.yaw_effort_rad += turn_rad_s * kHelicopterFrame_s;
  sums_.largest_speed_m_s = std::max(sums_.largest_speed_m_s, speed_m_s);
  sums_.largest_yaw_rate_rad_s = std::max(sums_.largest_yaw_rate_rad_s, turn_rad_s);
  if (step.saturated) sums_.saturated_s += kHelicopterFrame_s;
  if (step.refusal != LawRefusal::None) sums_.refused_s += kHelicopterFrame_s;
  if (!step.seen) sums_.unseen_s += kHelicopterFrame_s;
  wanted_.push_back(step.wanted);
}

void HelicopterMeter::add_matrix(const HelicopterStep& step) {
  if (step.rank == 0) return;
  is_singular_ = is_singular_ || !std::isfinite(step.condition);
  sums_.largest_condition = std::max(sums_.largest_condition.value_or(0), step.condition);
  const double smallest = step.smallest_singular_value;
  sums_.smallest_singular_value =
      std::min(sums_.smallest_singular_value.value_or(smallest), smallest);
}

HelicopterMetrics HelicopterMeter::metrics() const {
  HelicopterMetrics all = sums_;
  if (steps_ == 0) {
    all.smallest_margin_px = 0;
    return all;
  }
  all.settle_position_s = settled_s(last_bad_position_, steps_);
  all.settle_heading_s = settled_s(last_bad_heading_, steps_);
  all.settle_s = settled_s(std::max(last_bad_position_, last_bad_heading_), steps_);
  if (start_m_.norm() > kNoWay_m) all.path_ratio = all.path_m / start_m_.norm();
  all.final_position_m = positions_m_.back();
  all.final_heading_rad = headings_rad_.back();
  if (is_singular_) all.largest_condition.reset();
  all.steady_position_rms_m = root_mean_square(positions_m_);
  all.steady_heading_rms_rad = root_mean_square(headings_rad_);
  const Eigen::Vector4d spread = deviations(wanted_);
  all.steady_forward_std_m_s = spread[0];
  all.steady_right_std_m_s = spread[1];
  all.steady_down_std_m_s = spread[2];
  all.steady_yaw_rate_std_rad_s = spread[3];
  return all;
}

std::vector<std::pair<std::string, std::optional<double>>> named(const HelicopterMetrics& m) {
  return {{"settle_s", m.settle_s},
          {"settle_position_s", m.settle_position_s},
          {"settle_heading_s", m.settle_heading_s},
          {"path_m", m.path_m},
          {"path_ratio", m.path_ratio},
          {"final_position_m", m.final_position_m},
          {"final_heading_rad", m.final_heading_rad},
          {"final_error", m.final_error},
          {"iae_s", m.iae_s},
          {"ise_s", m.ise_s},
          {"itae_s2", m.itae_s2},
          {"position_iae_m_s", m.position_iae_m_s},
          {"effort_m", m.effort_m},
          {"yaw_effort_rad", m.yaw_effort_rad},
          {"saturated_s", m.saturated_s},
          {"refused_s", m.refused_s},
          {"unseen_s", m.unseen_s},
          {"largest_speed_m_s", m.largest_speed_m_s},
          {"largest_yaw_rate_rad_s", m.largest_yaw_rate_rad_s},
          {"largest_tilt_rad", m.largest_tilt_rad},
          {"overshoot_m", m.overshoot_m},
          {"smallest_margin_px", m.smallest_margin_px},
          {"first_out_of_view_s", m.first_out_of_view_s},
          {"largest_condition", m.largest_condition},
          {"smallest_singular_value", m.smallest_singular_value},
          {"steady_position_rms_m", m.steady_position_rms_m},
          {"steady_heading_rms_rad", m.steady_heading_rms_rad},
          {"steady_forward_std_m_s", m.steady_forward_std_m_s},
          {"steady_right_std_m_s", m.steady_right_std_m_s},
          {"steady_down_std_m_s", m.steady_down_std_m_s},
          {"steady_yaw_rate_std_rad_s", m.steady_yaw_rate_std_rad_s}};
}

}  // namespace kestrel

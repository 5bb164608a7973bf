#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// One frame of a helicopter run, the truth of it: everything a plot or a figure needs.
struct HelicopterStep {
  double time_s = 0;
  Eigen::Vector3d camera_m = Eigen::Vector3d::Zero();  // camera in the (moving) target's world, NED
  double position_error_m = 0;                         // of the levelled camera to its goal
  double heading_error_rad = 0;
  double error_norm = 0;       // |e| of the true points, levelled, normalised plane
  double image_margin_px = 0;  // of the point nearest to the border; negative: out of it
  VelocityCommand wanted;      // before limits and failsafe
  VelocityCommand sent;
  std::optional<double> condition;  // of the law, where it gave an answer
  bool seen = true;
  bool refused = false;
  bool saturated = false;  // sent is not what was wanted
};

/// What the figures are measured against.
struct HelicopterMeterOptions {
  double frame_s = 1.0 / 30;
  double position_tolerance_m = 0.10;
  double heading_tolerance_rad = 0.034906585039886591;
  double steady_share = 1.0 / 3;  // of the run, at its end: the steady state
};

/// Gathers the figures of a helicopter run while it goes on; give it every step in order.
class HelicopterMeter {
 public:
  explicit HelicopterMeter(const HelicopterMeterOptions& options = {});

  void add(const HelicopterStep& step);

  /// In this order (SI units; no value where there is none): settle_s (first time after which
  /// position and heading stay within tolerance), settle_position_s, settle_heading_s, path_m,
  /// path_ratio (over the straight line from start to end), final_position_m, final_heading_rad,
  /// final_error, iae (integral of error_norm), position_iae_m_s, effort_m (sum |v_sent| dt,
  /// translations), yaw_effort_rad, saturated_s, refused_s, unseen_s, overshoot_m (largest way
  /// beyond the goal along the line from the start), steady_position_rms_m,
  /// steady_heading_rms_rad, steady_forward_std_m_s, steady_right_std_m_s, steady_down_std_m_s,
  /// steady_yaw_rate_std_rad_s (of the command), smallest_margin_px, first_out_of_view_s,
  /// largest_condition, largest_speed_m_s, largest_yaw_rate_rad_s.
  std::vector<std::pair<std::string, std::optional<double>>> metrics() const;

 private:
  HelicopterMeterOptions options_;
  std::vector<HelicopterStep> steps_;
};

/// The names metrics() gives, in its order.
const std::vector<std::string>& helicopter_metric_names();

}  // namespace kestrel

#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kestrel/lab/helicopter_run.hpp"

namespace kestrel {

/// The figures of one helicopter run, of the true world at its frames. Lengths m, angles rad, times
/// s; the path is the camera's, relative to the target.
struct HelicopterMetrics {
  std::optional<double> settle_s;  // after it position and heading stay within tolerance
  std::optional<double> settle_position_s;
  std::optional<double> settle_heading_s;
  double path_m = 0;
  std::optional<double> path_ratio;  // over the straight line from start to goal
  double final_position_m = 0;
  double final_heading_rad = 0;  // absolute
  double final_error = 0;        // |e|
  double iae_s = 0;              // integral of |e|
  double ise_s = 0;
  double itae_s2 = 0;
  double position_iae_m_s = 0;  // integral of the position error
  double effort_m = 0;          // integral of the speed that was sent
  double yaw_effort_rad = 0;
  double saturated_s = 0;
  double refused_s = 0;
  double unseen_s = 0;
  double largest_speed_m_s = 0;  // sent
  double largest_yaw_rate_rad_s = 0;
  double largest_tilt_rad = 0;
  double overshoot_m = 0;         // largest way beyond the goal, along the line from start to goal
  double smallest_margin_px = 0;  // to the image's border; negative: out of it
  std::optional<double> first_out_of_view_s;
  std::optional<double> largest_condition;  // empty: singular, or none
  std::optional<double> smallest_singular_value;
  double steady_position_rms_m = 0;  // over the last third of the frames, as all below
  double steady_heading_rms_rad = 0;
  double steady_forward_std_m_s = 0;  // standard deviations of the command wanted
  double steady_right_std_m_s = 0;
  double steady_down_std_m_s = 0;
  double steady_yaw_rate_std_rad_s = 0;
};

/// The figures by the names of their columns, in the order of the struct.
std::vector<std::pair<std::string, std::optional<double>>> named(const HelicopterMetrics& metrics);

/// Gathers the figures while a run goes on; give it every step in order.
class HelicopterMeter {
 public:
  explicit HelicopterMeter(const HelicopterSetup& setup);
  void add(const HelicopterStep& step);
  HelicopterMetrics metrics() const;

 private:
  void add_errors(const HelicopterStep& step);
  void add_image(const HelicopterStep& step);
  void add_command(const HelicopterStep& step);
  void add_matrix(const HelicopterStep& step);

  LabCamera camera_;
  HelicopterRules rules_;
  HelicopterMetrics sums_;  // those that grow step by step
  int steps_ = 0;
  int last_bad_position_ = -1;
  int last_bad_heading_ = -1;
  Eigen::Vector3d start_m_ = Eigen::Vector3d::Zero();  // position error of the first frame
  Eigen::Vector3d last_m_ = Eigen::Vector3d::Zero();
  bool is_singular_ = false;
  std::vector<double> positions_m_;
  std::vector<double> headings_rad_;
  std::vector<VelocityCommand> wanted_;
};

}  // namespace kestrel

#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kestrel/lab/camera_run.hpp"

namespace kestrel {

/// The figures of one run, of the true points and poses at its steps k = 0, 1, ...; e, D, v as
/// there, D = distance from the camera to the target's centre, c the start, * the goal. Lengths m,
/// angles rad, times s.
struct RunMetrics {
  std::optional<int> k_error;  // first step after which |e| < threshold for good
  std::optional<int> k_pose;   // first step after which the pose is within tolerance for good
  double initial_error = 0;    // |e|
  double final_error = 0;
  double iae_s = 0;                   // integral of |e|
  double ise_s = 0;                   // of |e|^2
  double itae_s2 = 0;                 // of t |e|
  std::optional<double> image_ratio;  // sum of the points' image paths over that of their chords
  double image_deviation_px = 0;      // largest distance of a point from the line of its chord
  double path_m = 0;                  // of the camera
  std::optional<double> path_ratio;   // over the straight line; empty: there is no way to go
  double retreat_m = 0;               // max D - max(D_0, D*)
  double approach_m = 0;              // min(D_0, D*) - min D
  double max_linear_m_s = 0;
  double max_angular_rad_s = 0;
  double saturated_s = 0;
  double effort = 0;                        // integral of |v|, m and rad together
  double smallest_margin_px = 0;            // to the image's border; negative: out of it
  std::optional<int> first_out_of_view;     // step
  std::optional<double> largest_condition;  // of the law's matrix; empty: singular, or none
  std::optional<double> smallest_singular_value;
  double final_position_m = 0;  // |t| of c*Mc
  double final_angle_rad = 0;
  double steady_position_rms_m = 0;  // over the last third of the steps
  double steady_angle_rms_rad = 0;
};

/// The figures by the names of their columns, in a fixed order; steps are also given in seconds.
std::vector<std::pair<std::string, std::optional<double>>> named(const RunMetrics& metrics,
                                                                 double rate_hz);

/// Gathers the figures while a run goes on; give it every step in order.
class RunMeter {
 public:
  explicit RunMeter(const CameraSetup& setup);
  void add(const RunStep& step);
  RunMetrics metrics() const;

 private:
  void add_error(const RunStep& step);
  void add_image(const RunStep& step);
  void add_camera(const RunStep& step);
  void add_matrix(const RunStep& step);

  LabCamera camera_;
  RunRules rules_;
  double period_s_;
  Eigen::Vector3d centre_m_;
  double goal_depth_m_;
  double goal_distance_m_;
  std::vector<Pixel> goal_px_;

  RunMetrics sums_;  // those that grow step by step
  int steps_ = 0;
  int last_bad_error_ = -1;  // steps
  int last_bad_pose_ = -1;
  std::vector<Pixel> first_px_;
  std::vector<Pixel> last_px_;
  double image_path_px_ = 0;
  Eigen::Vector3d last_position_m_ = Eigen::Vector3d::Zero();
  double first_way_m_ = 0;  // from the start to the goal, straight
  double first_distance_m_ = 0;
  double nearest_m_ = 0;
  double farthest_m_ = 0;
  bool is_singular_ = false;
  std::vector<double> position_errors_m_;
  std::vector<double> angle_errors_rad_;
};

}  // namespace kestrel

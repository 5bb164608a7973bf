#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/io/report.hpp"
#include "kestrel/io/run_log.hpp"

namespace kestrel {

/// What the figures of a run need beside its log.
struct RunView {
  int image_width = 0;  // px; 0: no border drawn
  int image_height = 0;
  std::optional<std::array<Pixel, 4>> goal_corners;  // px
  std::optional<CommandLimits> limits;
  std::optional<double> position_tolerance_m;  // of having arrived
  std::optional<double> angle_tolerance_rad;
};

/// Sections on what was seen: corners in the image, found or lost, keypoints and matches.
std::vector<ReportSection> track_sections(const LogFile& log, const RunView& view);

/// The same and what was made of it: feature errors ("Visual features error", "Camera velocities"
/// as ViSP's users know them), commands wanted and sent with their limits, pose of the target.
std::vector<ReportSection> servo_sections(const LogFile& log, const RunView& view);

/// The same and the helicopter's flight, from those of truth_columns() the log has.
std::vector<ReportSection> simulate_sections(const LogFile& log, const RunView& view);

/// Extra columns in which the simulator logs the truth: position in World (north_m, east_m,
/// down_m), attitude (true_roll_rad, true_pitch_rad, true_yaw_rad), and distance and angle of the
/// camera to its goal (position_error_m, angle_error_rad).
std::vector<std::string> truth_columns();

}  // namespace kestrel

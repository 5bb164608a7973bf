#pragma once

#include <string>
#include <vector>

#include "kestrel/lab/helicopter_run.hpp"

namespace kestrel {

/// The columns of a trace of a helicopter run with so many points, in order: step, time_s; north_m
/// east_m down_m roll_rad pitch_rad yaw_rad of the body; v_north_m_s v_east_m_s v_down_m_s
/// yaw_rate_rad_s; camera_north_m camera_east_m camera_down_m; then, each with forward_m_s,
/// right_m_s, down_m_s, yaw_rate_rad_s behind it, wanted_ (before limits and failsafe) and sent_;
/// for each point i: u<i>_px, v<i>_px (as the tilted camera sees it); error_norm; condition,
/// sigma_min of the law's matrix; position_error_m, heading_error_rad; seen (0, 1); refused (number
/// of the LawRefusal, 0: none); saturated (0, 1).
std::vector<std::string> helicopter_trace_columns(std::size_t points);

/// A step as a row of these columns. NaN: no value (nothing was inverted, or it is singular).
std::vector<double> helicopter_trace_row(const HelicopterStep& step, const LabCamera& camera);

}  // namespace kestrel

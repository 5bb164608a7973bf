#pragma once

#include <string>
#include <vector>

#include "kestrel/lab/camera_run.hpp"

namespace kestrel {

/// The columns of a trace of a run with so many points, in order:
/// step, time_s; error_norm = |e|; for each point i: x<i>, y<i> (normalised), z<i>_m, u<i>_px,
/// v<i>_px, e<i>x, e<i>y; vx_m_s vy_m_s vz_m_s wx_rad_s wy_rad_s wz_rad_s, the twist applied, in
/// the camera; tx_m ty_m tz_m tux_rad tuy_rad tuz_rad, position and rotation vector of c*Mc;
/// distance_m, camera to the target's centre; rank, condition, sigma_min, s1 .. s6, of the law's
/// matrix; saturated (0, 1); refused (number of the LawRefusal, 0: none).
std::vector<std::string> camera_trace_columns(std::size_t points);

/// A step as a row of these columns. NaN: no value (nothing was inverted, or it is singular).
/// centre_m: the target's centre in Target.
std::vector<double> camera_trace_row(const RunStep& step, const LabCamera& camera,
                                     const Eigen::Vector3d& centre_m);

}  // namespace kestrel

#include "kestrel/lab/camera_trace.hpp"

#include <cmath>
#include <limits>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

constexpr Eigen::Index kSingularValues = 6;

void append(std::vector<double>& row, const Eigen::Vector3d& v) {
  row.insert(row.end(), v.data(), v.data() + 3);
}

/// Rank, condition, smallest and all singular values.
void append_matrix(std::vector<double>& row, const RunStep& step) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const bool is_there = step.rank > 0;
  row.push_back(step.rank);
  row.push_back(is_there && std::isfinite(step.condition) ? step.condition : kNone);
  row.push_back(is_there ? step.smallest_singular_value : kNone);
  for (Eigen::Index i = 0; i < kSingularValues; ++i) {
    row.push_back(i < step.singular_values.size() ? step.singular_values[i] : kNone);
  }
}

}  // namespace

std::vector<std::string> camera_trace_columns(std::size_t points) {
  std::vector<std::string> columns{"step", "time_s", "error_norm"};
  for (std::size_t i = 0; i < points; ++i) {
    const std::string n = std::to_string(i);
    for (const char* form : {"x#", "y#", "z#_m", "u#_px", "v#_px", "e#x", "e#y"}) {
      std::string column = form;
      columns.push_back(column.replace(1, 1, n));
    }
  }
  for (const char* column :
       {"vx_m_s",     "vy_m_s", "vz_m_s",    "wx_rad_s",  "wy_rad_s",  "wz_rad_s",
        "tx_m",       "ty_m",   "tz_m",      "tux_rad",   "tuy_rad",   "tuz_rad",
        "distance_m", "rank",   "condition", "sigma_min", "s1",        "s2",
        "s3",         "s4",     "s5",        "s6",        "saturated", "refused"}) {
    columns.emplace_back(column);
  }
  return columns;
}

std::vector<double> camera_trace_row(const RunStep& step, const LabCamera& camera,
                                     const Eigen::Vector3d& centre_m) {
  std::vector<double> row{double(step.step), step.time_s, step.error.norm()};
  row.reserve(27 + 7 * step.points.size());
  for (std::size_t i = 0; i < step.points.size(); ++i) {
    const Feature& point = step.points[i];
    const Pixel px = camera.to_pixel(point.at);
    const auto e = step.error.segment<2>(Eigen::Index(2 * i));
    row.insert(row.end(), {point.at.x, point.at.y, point.depth_m, px.u, px.v, e[0], e[1]});
  }
  append(row, step.twist.linear);
  append(row, step.twist.angular);
  append(row, step.goal_from_camera.translation);
  append(row, rotation_vector(step.goal_from_camera.rotation));
  row.push_back((step.camera_from_target * centre_m).norm());
  append_matrix(row, step);
  row.push_back(step.saturated ? 1 : 0);
  row.push_back(int(step.refusal));
  return row;
}

}  // namespace kestrel

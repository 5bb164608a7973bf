#include "kestrel/lab/helicopter_trace.hpp"

#include <cmath>
#include <limits>

namespace kestrel {
namespace {

void append(std::vector<double>& row, const Eigen::Vector3d& v) {
  row.insert(row.end(), v.data(), v.data() + 3);
}

void append(std::vector<double>& row, const VelocityCommand& command) {
  const Eigen::Vector4d v = command.vector();
  row.insert(row.end(), v.data(), v.data() + 4);
}

}  // namespace

std::vector<std::string> helicopter_trace_columns(std::size_t points) {
  std::vector<std::string> columns{
      "step",       "time_s",         "north_m",        "east_m",        "down_m",
      "roll_rad",   "pitch_rad",      "yaw_rad",        "v_north_m_s",   "v_east_m_s",
      "v_down_m_s", "yaw_rate_rad_s", "camera_north_m", "camera_east_m", "camera_down_m",
  };
  for (const char* stage : {"wanted_", "sent_"}) {
    for (const char* component : {"forward_m_s", "right_m_s", "down_m_s", "yaw_rate_rad_s"}) {
      columns.push_back(std::string(stage) + component);
    }
  }
  for (std::size_t i = 0; i < points; ++i) {
    columns.push_back("u" + std::to_string(i) + "_px");
    columns.push_back("v" + std::to_string(i) + "_px");
  }
  for (const char* column : {"error_norm", "condition", "sigma_min", "position_error_m",
                             "heading_error_rad", "seen", "refused", "saturated"}) {
    columns.emplace_back(column);
  }
  return columns;
}

std::vector<double> helicopter_trace_row(const HelicopterStep& step, const LabCamera& camera) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const HelicopterState& s = step.frame.state;
  std::vector<double> row{double(step.frame.step), step.frame.time_s};
  row.reserve(31 + 2 * step.frame.points.size());
  append(row, s.position_m);
  row.insert(row.end(), {s.roll, s.pitch, s.yaw});
  append(row, s.velocity_m_s);
  row.push_back(s.yaw_rate_rad_s);
  append(row, step.frame.world_from_camera.translation);
  append(row, step.wanted);
  append(row, step.sent);
  for (const Feature& f : step.frame.points) {
    const Pixel px = camera.to_pixel(f.at);
    row.insert(row.end(), {px.u, px.v});
  }
  const bool inverted = step.rank > 0;
  row.push_back(step.error_norm);
  row.push_back(inverted && std::isfinite(step.condition) ? step.condition : kNone);
  row.push_back(inverted ? step.smallest_singular_value : kNone);
  row.insert(row.end(), {step.position_error_m.norm(), step.heading_error_rad, double(step.seen),
                         double(step.refusal), double(step.saturated)});
  return row;
}

}  // namespace kestrel

#include "kestrel/io/run_figures.hpp"

#include "run_series.hpp"

namespace kestrel {
namespace {

std::vector<double> scaled(std::vector<double> values, double unit) {
  for (double& value : values) value *= unit;
  return values;
}

// The extra columns the log has, over time.
std::string plot_of(const LogFile& log, Plot plot, const std::vector<std::string>& columns,
                    const std::vector<std::string>& names, double unit) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    plot.series.push_back({names[i], times(log), scaled(log.extra(columns[i]), unit)});
  return svg_plot(plot);
}

std::string ground_track(const LogFile& log) {
  Plot plot = empty_plot("Path seen from above", "east (m)", "north (m)");
  plot.axes = Plot::Axes::Equal;
  plot.height_px = 420;
  const std::vector<double> east = log.extra("east_m");
  const std::vector<double> north = log.extra("north_m");
  plot.series = {{"", east, north}};
  if (!east.empty() && !north.empty())
    plot.marks = {{"start", east.front(), north.front(), Shape::Circle, 0},
                  {"end", east.back(), north.back(), Shape::Cross, 1}};
  return svg_plot(plot);
}

std::string goal_distance(const LogFile& log, const RunView& view) {
  Plot plot = time_plot("Distance to the goal", "m");
  plot.y_spacing = Spacing::Logarithmic;
  if (view.position_tolerance_m) plot.limits = {{*view.position_tolerance_m, "arrived"}};
  return plot_of(log, plot, {"position_error_m"}, {""}, 1);
}

std::string goal_angle(const LogFile& log, const RunView& view) {
  Plot plot = time_plot("Angle to the goal", "deg");
  plot.y_spacing = Spacing::Logarithmic;
  if (view.angle_tolerance_rad) plot.limits = {{kDegrees * *view.angle_tolerance_rad, "arrived"}};
  return plot_of(log, plot, {"angle_error_rad"}, {""}, kDegrees);
}

}  // namespace

std::vector<ReportSection> simulate_sections(const LogFile& log, const RunView& view) {
  std::vector<ReportSection> out = servo_sections(log, view);
  out.insert(out.begin(),
             {"How the helicopter flew",
              "The simulator's truth: the world is north, east, down; angles of attitude are "
              "positive for right side down, nose up and clockwise seen from above.",
              {ground_track(log),
               plot_of(log, time_plot("Position", "m"), {"north_m", "east_m", "down_m"},
                       {"north", "east", "down"}, 1),
               goal_distance(log, view), goal_angle(log, view),
               plot_of(log, time_plot("Attitude", "deg"),
                       {"true_roll_rad", "true_pitch_rad", "true_yaw_rad"},
                       {"roll", "pitch", "yaw"}, kDegrees)}});
  return out;
}

std::vector<std::string> truth_columns() {
  return {"north_m",        "east_m",       "down_m",           "true_roll_rad",
          "true_pitch_rad", "true_yaw_rad", "position_error_m", "angle_error_rad"};
}

}  // namespace kestrel

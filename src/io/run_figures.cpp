#include "kestrel/io/run_figures.hpp"

#include <algorithm>

#include "kestrel/io/svg_strip.hpp"

#include "run_series.hpp"

namespace kestrel {
namespace {

Stroke dashed_if(bool is_second) { return is_second ? Stroke::Dashed : Stroke::Solid; }

std::string errors(const LogFile& log) {
  Plot plot = time_plot("Visual features error", "normalised plane");
  for (std::size_t i = 0; i < 8; ++i)
    plot.series.push_back({"error_feat_p" + std::to_string(i / 2 + 1) + (i % 2 ? "_y" : "_x"),
                           times(log),
                           column(log, &LogRow::servo, [&](const auto& s) { return s.error[i]; }),
                           int(i / 2), dashed_if(i % 2 == 1)});
  plot.height_px = 340;
  return svg_plot(plot);
}

std::string error_norm(const LogFile& log) {
  Plot plot = time_plot("Norm of the error", "‖e‖, normalised plane");
  plot.y_spacing = Spacing::Logarithmic;
  plot.series = {
      {"", times(log), column(log, &LogRow::servo, [](const auto& s) { return s.error_norm; })}};
  plot.height_px = 340;
  return svg_plot(plot);
}

std::string camera_velocities(const LogFile& log) {
  static constexpr const char* kNames[] = {"vc_x", "vc_y", "vc_z", "wc_x", "wc_y", "wc_z"};
  Plot plot = time_plot("Camera velocities", "m/s, rad/s");
  for (int i = 0; i < 6; ++i)
    plot.series.push_back(
        {kNames[i], times(log),
         column(log, &LogRow::servo, [&](const auto& s) { return s.twist.vector()[i]; }), i % 3,
         dashed_if(i >= 3)});
  return svg_plot(plot);
}

std::string condition(const LogFile& log) {
  Plot plot = time_plot("Condition of the task", "largest over smallest singular value");
  plot.y_spacing = Spacing::Logarithmic;
  plot.series = {
      {"", times(log), column(log, &LogRow::servo, [](const auto& s) { return s.condition; })}};
  return svg_plot(plot);
}

std::string command(const LogFile& log, const RunView& view, int axis) {
  static constexpr const char* kNames[] = {"forward", "right", "down", "yaw rate"};
  const double unit = axis == 3 ? kDegrees : 1;
  Plot plot = time_plot(std::string("Command: ") + kNames[axis], axis == 3 ? "deg/s" : "m/s");
  plot.series = {
      {"wanted", times(log),
       column(log, &LogRow::decision,
              [&](const auto& d) { return unit * d.wanted.vector()[axis]; }),
       4, Stroke::Dashed},
      {"sent", times(log),
       column(log, &LogRow::decision, [&](const auto& d) { return unit * d.sent.vector()[axis]; }),
       0}};
  if (view.limits) {
    const double limit = unit * view.limits->speed.vector()[axis];
    plot.limits = {{limit, "limit"}, {-limit, "limit"}};
  }
  plot.height_px = 250;
  return svg_plot(plot);
}

std::string states(const LogFile& log) {
  Strip strip{"What the command rests on", "time (s)", {}, times(log), {}};
  const auto by_hand = [](const LogRow& row) {
    return row.decision && row.decision->state == CommandState::Sticks;
  };
  const bool flown_by_hand = std::any_of(log.rows.begin(), log.rows.end(), by_hand);
  for (const CommandState state : kCommandStates) {
    // Most runs know no hand: no empty lane for it.
    if (state != CommandState::Sticks || flown_by_hand) strip.lanes.emplace_back(name(state));
  }
  for (const LogRow& row : log.rows)
    strip.states.emplace_back(row.decision ? name(row.decision->state) : "");
  return svg_strip(strip);
}

std::string translation(const LogFile& log) {
  Plot plot = time_plot("Target in the camera: translation", "m");
  static constexpr const char* kNames[] = {"x right", "y down", "z ahead"};
  for (int i = 0; i < 3; ++i)
    plot.series.push_back({kNames[i], times(log), column(log, &LogRow::pose, [&](const auto& p) {
                             return p.translation_m[i];
                           })});
  return svg_plot(plot);
}

std::string rotation(const LogFile& log) {
  Plot plot = time_plot("Target in the camera: rotation θu", "deg");
  static constexpr const char* kNames[] = {"θu x", "θu y", "θu z"};
  for (int i = 0; i < 3; ++i)
    plot.series.push_back({kNames[i], times(log), column(log, &LogRow::pose, [&](const auto& p) {
                             return kDegrees * p.rotation_rad[i];
                           })});
  return svg_plot(plot);
}

void append(std::vector<ReportSection>& sections, ReportSection section) {
  sections.push_back(std::move(section));
}

}  // namespace

std::vector<ReportSection> servo_sections(const LogFile& log, const RunView& view) {
  std::vector<ReportSection> out = track_sections(log, view);
  append(out, {"What the servo made of it",
               "Error of the four corners against the goal, and the camera velocity the law "
               "answered with. Dashed: y of a point, or an angular velocity.",
               {errors(log), error_norm(log), camera_velocities(log), condition(log)}});
  append(out, {"What was commanded",
               "Velocity references in the heading frame, before and after the limits on speed and "
               "on its change.",
               {command(log, view, 0), command(log, view, 1), command(log, view, 2),
                command(log, view, 3), states(log)}});
  append(out, {"Where the target was",
               "Pose of the target in the camera frame (x right, y down, z forward) as the "
               "homography gives it.",
               {translation(log), rotation(log)}});
  return out;
}

}  // namespace kestrel

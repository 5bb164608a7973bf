#include <algorithm>
#include <cmath>

#include "kestrel/io/run_figures.hpp"
#include "kestrel/io/svg_strip.hpp"

#include "run_series.hpp"

namespace kestrel {
namespace {

std::string strip(const LogFile& log) {
  Strip out{"Tracker: found or why not", "time (s)", {"found"}, times(log), {}};
  for (const Miss miss : kMisses)
    for (const LogRow& row : log.rows)
      if (miss != Miss::None && row.miss == miss && out.lanes.back() != name(miss))
        out.lanes.emplace_back(name(miss));
  for (const LogRow& row : log.rows)
    out.states.emplace_back(row.image_from_template ? "found" : name(row.miss));
  return svg_strip(out);
}

void add_border(Plot& plot, const RunView& view) {
  const double right = view.image_width - 0.5;  // the first pixel's centre is (0, 0)
  const double bottom = view.image_height - 0.5;
  if (right > 0 && bottom > 0)
    plot.series.push_back({"image border",
                           {-0.5, right, right, -0.5, -0.5},
                           {-0.5, -0.5, bottom, bottom, -0.5},
                           6,
                           Stroke::Faint});
}

void add_marks(Plot& plot, const LogFile& log, const RunView& view, std::size_t corner) {
  for (const LogRow& row : log.rows) {
    if (!row.corners) continue;
    const Pixel& first = (*row.corners)[corner];
    plot.marks.push_back({"start", first.u, first.v, Shape::Circle, int(corner)});
    break;
  }
  if (!view.goal_corners) return;
  const Pixel& goal = (*view.goal_corners)[corner];
  plot.marks.push_back({"goal", goal.u, goal.v, Shape::Cross, int(corner)});
}

std::string trajectories(const LogFile& log, const RunView& view) {
  static constexpr const char* kNames[] = {"p1 top left", "p2 top right", "p3 bottom right",
                                           "p4 bottom left"};
  Plot plot = empty_plot("Corners in the image", "u (px)", "v (px)");
  plot.axes = Plot::Axes::EqualDown;
  plot.height_px = 500;
  plot.when_empty = "the target was never found";
  for (std::size_t i = 0; i < 4; ++i) {
    plot.series.push_back(
        {kNames[i], column(log, &LogRow::corners, [&](const auto& c) { return c[i].u; }),
         column(log, &LogRow::corners, [&](const auto& c) { return c[i].v; }), int(i)});
    add_marks(plot, log, view, i);
  }
  add_border(plot, view);
  return svg_plot(plot);
}

std::string counts(const LogFile& log) {
  Plot plot = time_plot("Matches and inliers", "count");
  plot.series = {{"matches", times(log), column(log, [](const LogRow& r) { return r.matches; })},
                 {"inliers", times(log), column(log, [](const LogRow& r) { return r.inliers; })}};
  plot.height_px = 230;
  return svg_plot(plot);
}

std::string keypoints(const LogFile& log) {
  Plot plot = time_plot("Keypoints in the window", "count");
  plot.series = {{"", times(log), column(log, [](const LogRow& r) { return r.keypoints; })}};
  plot.height_px = 230;
  return svg_plot(plot);
}

std::string trials(const LogFile& log) {
  Plot plot = time_plot("Trials of RANSAC", "count");
  plot.series = {{"", times(log), column(log, [](const LogRow& r) { return r.trials; })}};
  plot.height_px = 230;
  return svg_plot(plot);
}

std::string window(const LogFile& log) {
  Plot plot = time_plot("Size of the processed window", "px");
  plot.series = {
      {"width", times(log), column(log, [](const LogRow& r) { return r.window.width; })},
      {"height", times(log), column(log, [](const LogRow& r) { return r.window.height; })}};
  plot.height_px = 230;
  return svg_plot(plot);
}

std::string confidence(const LogFile& log) {
  Plot plot = time_plot("Confidence, and blocks of the template that are alike", "share");
  plot.series = {
      {"confidence", times(log), column(log, [](const LogRow& r) { return r.confidence; })},
      {"alike", times(log), column(log, [](const LogRow& r) { return r.alike_share; })}};
  plot.height_px = 230;
  return svg_plot(plot);
}

std::string deviation(const LogFile& log) {
  Plot plot = time_plot("Uncertainty of the corners (standard deviation)", "px");
  plot.series = {{"", times(log), column(log, &LogRow::noise, [](const CornerNoise& noise) {
                    double sum = 0;
                    for (const auto& corner : noise) sum += corner[0] + corner[2];
                    return std::sqrt(sum / 8);
                  })}};
  plot.height_px = 230;
  return svg_plot(plot);
}

/// The plots of what a tracker counts; of keypoints where any were looked for.
std::vector<std::string> figures(const LogFile& log, const RunView& view) {
  std::vector<std::string> all{trajectories(log, view), strip(log), confidence(log),
                               deviation(log)};
  const auto any = [&](int LogRow::*count) {
    return std::any_of(log.rows.begin(), log.rows.end(),
                       [&](const LogRow& row) { return row.*count > 0; });
  };
  if (any(&LogRow::matches)) all.push_back(counts(log));
  if (any(&LogRow::keypoints)) all.push_back(keypoints(log));
  if (any(&LogRow::trials)) all.push_back(trials(log));
  all.push_back(window(log));
  return all;
}

}  // namespace

std::vector<ReportSection> track_sections(const LogFile& log, const RunView& view) {
  return {
      {"What was seen",
       "The path of the template's four corners through the image, in which frames the tracker "
       "had an answer, and what it rests on: the share of the template that the pixels show, and, "
       "where keypoints were looked for, how many there are in the processed window, match the "
       "template and agree on one homography.",
       figures(log, view)}};
}

}  // namespace kestrel

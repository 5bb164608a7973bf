#include "kestrel/calibration/calibration_page.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "kestrel/calibration/calibration_table.hpp"
#include "kestrel/calibration/undistortion.hpp"
#include "kestrel/io/svg_bars.hpp"
#include "kestrel/io/svg_heat_map.hpp"
#include "kestrel/io/svg_plot.hpp"

namespace kestrel {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

std::string coverage_figure(const CalibrationResult& result) {
  const Coverage& c = result.coverage;
  HeatMap map;
  map.title = "Where the board was seen";
  map.x_label = "u [px]";
  map.y_label = "v [px]";
  map.value_label = "points of the board in the cell, all views";
  const auto edge = [](int i, int count, int size) { return std::to_string(size * i / count); };
  for (int i = 0; i < c.columns; ++i) map.x.push_back(edge(i, c.columns, result.job.size.width));
  for (int row = c.rows - 1; row >= 0; --row) {  // the map's row 0 is at the bottom
    map.y.push_back(edge(row, c.rows, result.job.size.height));
    map.cells.emplace_back();
    for (int i = 0; i < c.columns; ++i) {
      const int count = c.counts[std::size_t(row) * std::size_t(c.columns) + std::size_t(i)];
      map.cells.back().push_back({count > 0 ? double(count) : kGap, ""});
    }
  }
  return svg_heat_map(map);
}

/// A line from each point to where the residual, many times as long, points.
std::string residual_field(const CalibrationResult& result) {
  const Calibration& c = *result.calibration;
  const double enlarged = std::max(1.0, std::round(0.02 * c.camera.width / c.rms_px));
  Series lines{"", {}, {}};
  Series dots{"", {}, {}, 5, Stroke::Faint};
  for (const SolvedView& view : c.views) {
    for (const PointResidual& r : view.residuals) {
      lines.x.insert(lines.x.end(), {r.seen.u, r.seen.u + enlarged * r.du_px, kGap});
      lines.y.insert(lines.y.end(), {r.seen.v, r.seen.v + enlarged * r.dv_px, kGap});
    }
  }
  const double w = c.camera.width;
  const double h = c.camera.height;
  dots.x = {0, w, w, 0, 0};
  dots.y = {0, 0, h, h, 0};
  lines.colour = 1;
  Plot plot;
  plot.title = fmt::format("Residuals over the image, {:.0f} times as long", enlarged);
  plot.x_label = "u [px]";
  plot.y_label = "v [px]";
  plot.axes = Plot::Axes::EqualDown;
  plot.series = {dots, lines};
  plot.height_px = 520;
  return svg_plot(plot);
}

std::string residual_cloud(const Calibration& c) {
  Plot plot;
  plot.title = "Residuals: where points are put less where they were seen";
  plot.x_label = "du [px]";
  plot.y_label = "dv [px]";
  plot.axes = Plot::Axes::EqualDown;
  plot.height_px = 480;
  constexpr double kArm = 0.012;  // of the range: a small cross for each point
  double widest = 0;
  for (const SolvedView& view : c.views) widest = std::max(widest, view.worst_px);
  Series crosses{"", {}, {}, 0};
  const double arm = kArm * widest;
  for (const SolvedView& view : c.views) {
    for (const PointResidual& r : view.residuals) {
      crosses.x.insert(crosses.x.end(),
                       {r.du_px - arm, r.du_px + arm, kGap, r.du_px, r.du_px, kGap});
      crosses.y.insert(crosses.y.end(),
                       {r.dv_px, r.dv_px, kGap, r.dv_px - arm, r.dv_px + arm, kGap});
    }
  }
  plot.series = {crosses};
  return svg_plot(plot);
}

std::string view_bars(const Calibration& c) {
  BarChart chart;
  chart.title = "Reprojection error of each view";
  chart.value_label = "root mean square [px]";
  for (const SolvedView& view : c.views) chart.bars.push_back({view.name, view.rms_px});
  return svg_bars(chart);
}

/// A ring around each point that was found.
cv::Mat with_points(const cv::Mat& picture, const BoardView& view) {
  cv::Mat colour;
  cv::cvtColor(picture, colour, cv::COLOR_GRAY2BGR);
  const int radius = std::max(3, picture.cols / 200);
  for (const BoardPoint& p : view.points) {
    const cv::Point at(int(std::lround(p.in_image.u)), int(std::lround(p.in_image.v)));
    cv::circle(colour, at, radius, {0, 94, 213}, std::max(1, radius / 3), cv::LINE_AA);
  }
  return colour;
}

std::vector<ReportPicture> pictures(const CalibrationResult& result, const cv::Mat& picture,
                                    std::size_t view) {
  if (picture.empty() || view >= result.job.views.size()) return {};
  const BoardView& shown = result.job.views[view];
  std::vector<ReportPicture> all{report_picture(shown.name + ", as taken, with the points found",
                                                with_points(picture, shown))};
  if (result.calibration) {
    all.push_back(report_picture("the same, undistorted: straight lines are straight",
                                 undistorted(picture, Camera(result.calibration->camera))));
  }
  return all;
}

std::vector<ReportSection> sections(const CalibrationResult& result) {
  std::vector<ReportSection> all;
  all.push_back(
      {"Coverage", "A cell without points: there the lens is a guess.", {coverage_figure(result)}});
  if (!result.calibration) return all;
  const Calibration& c = *result.calibration;
  all.push_back({"Camera",
                 "Standard deviations come from the residuals and how the numbers depend on each "
                 "other; they do not know of a board that is bent or measured wrongly.",
                 {},
                 {parameter_table(result)}});
  all.push_back({"Residuals",
                 "Good residuals look like chance: arrows that agree in a part of the image show a "
                 "lens model that does not fit.",
                 {residual_field(result), residual_cloud(c)}});
  all.push_back({"Views",
                 "A view that stands out is blurred, or the board was bent in it.",
                 {view_bars(c)},
                 {view_table(result)}});
  if (!result.visp) return all;
  all.push_back(
      {"ViSP's answer",
       "ViSP's calibration of the same views beside our minimum of the same sum of squares. "
       "With a lens that sum is ViSP's own: kud and kdu are fitted at once, each to every "
       "point. So this lens is not the one above; the two programs must agree on it.",
       {},
       {visp_table(result)}});
  return all;
}

}  // namespace

Report calibration_report(const CalibrationResult& result, const cv::Mat& picture,
                          std::size_t view) {
  Report report;
  report.title =
      is_refused(result.objections) ? "Camera calibration: refused" : "Camera calibration";
  report.what = fmt::format("Board {}, lens model {}, {} views.", to_string(result.job.board),
                            name(result.job.model), result.job.views.size());
  for (const Objection& o : result.objections) {
    report.warnings.push_back((o.gravity == Gravity::Refusal ? "Refused: " : "") + o.what + "; " +
                              o.remedy + ".");
  }
  report.summary = summary_of(result);
  report.pictures = pictures(result, picture, view);
  report.sections = sections(result);
  return report;
}

}  // namespace kestrel

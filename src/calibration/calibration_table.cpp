#include "kestrel/calibration/calibration_table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "kestrel/eval/table.hpp"
#include "kestrel/geometry/nearest_visp_camera.hpp"

namespace kestrel {
namespace {

constexpr double kDegree = M_PI / 180;

/// Angle between the board's normal and the camera's axis, rad.
double tilt(const SolvedView& view) {
  return std::acos(std::min(1.0, std::abs(view.camera_from_board.rotation(2, 2))));
}

double worst_view_px(const Calibration& calibration) {
  double worst = 0;
  for (const SolvedView& view : calibration.views) worst = std::max(worst, view.rms_px);
  return worst;
}

/// The angle between the rays of two pixels, rad.
double angle_between(const Camera& camera, const Pixel& a, const Pixel& b) {
  const ImagePoint p = camera.to_image_point(a);
  const ImagePoint q = camera.to_image_point(b);
  const Eigen::Vector3d u(p.x, p.y, 1);
  const Eigen::Vector3d v(q.x, q.y, 1);
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

void add_camera(const Calibration& c, Summary& summary) {
  const Camera camera(c.camera);
  const CameraParameters& p = c.camera;
  summary.begin_section("camera");
  summary.add("seen across the width",
              angle_between(camera, {0, p.v0}, {p.width - 1.0, p.v0}) / kDegree, "deg");
  summary.add("seen across the height",
              angle_between(camera, {p.u0, 0}, {p.u0, p.height - 1.0}) / kDegree, "deg");
  summary.add("nearest lens of ViSP is off by", nearest_visp_camera(camera).largest_px, "px");
}

std::string digits(double value) { return fmt::format("{:.6g}", value); }

}  // namespace

Summary summary_of(const CalibrationResult& result) {
  Summary s;
  s.begin_section("calibration");
  s.add("board", to_string(result.job.board));
  s.add("lens model", name(result.job.model));
  s.add("image", fmt::format("{} x {} px", result.job.size.width, result.job.size.height));
  s.add("views", int(result.job.views.size()));
  s.add("image covered", 100 * result.coverage.share, "%");
  s.add("refused", is_refused(result.objections));
  if (!result.calibration) return s;
  const Calibration& c = *result.calibration;
  s.begin_section("errors");
  s.add("reprojection, rms", c.rms_px, "px");
  s.add("worst view, rms", worst_view_px(c), "px");
  if (result.hold_out) s.add("views left out, rms", result.hold_out->rms_px, "px");
  s.add("noise of a coordinate", c.noise_px, "px");
  add_camera(c, s);
  if (!result.visp) return s;
  s.begin_section("ViSP on the same views");
  s.add("reprojection of ViSP, rms", result.visp->visp_rms_px, "px");
  s.add("reprojection of ours with that model, rms", result.visp->ours.rms_px, "px");
  s.add("largest difference", result.visp->largest_deviations, "standard deviations");
  return s;
}

ReportTable parameter_table(const CalibrationResult& result) {
  ReportTable table{"Camera", {"parameter", "value", "standard deviation", "unit"}, {}};
  if (!result.calibration) return table;
  for (const ParameterEstimate& p : result.calibration->parameters)
    table.rows.push_back({p.name, digits(p.value), fmt::format("{:.2g}", p.deviation), p.unit});
  return table;
}

ReportTable view_table(const CalibrationResult& result) {
  ReportTable table{
      "Views", {"picture", "points", "rms [px]", "worst [px]", "distance [m]", "tilt [deg]"}, {}};
  if (!result.calibration) return table;
  for (const SolvedView& view : result.calibration->views) {
    table.rows.push_back({view.name, std::to_string(view.residuals.size()),
                          fmt::format("{:.3f}", view.rms_px), fmt::format("{:.2f}", view.worst_px),
                          fmt::format("{:.3f}", view.camera_from_board.translation.norm()),
                          fmt::format("{:.1f}", tilt(view) / kDegree)});
  }
  return table;
}

ReportTable visp_table(const CalibrationResult& result) {
  ReportTable table{
      "ViSP's calibration of the same views",
      {"parameter", "ViSP", "ours, same sum of squares", "difference", "our deviation"},
      {}};
  if (!result.visp) return table;
  const VispCheck& check = *result.visp;
  const std::vector<double> theirs = visp_values(check);
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    const ParameterEstimate& mine = check.ours.parameters[i];
    table.rows.push_back({mine.name, digits(theirs[i]), digits(mine.value),
                          fmt::format("{:.2g}", theirs[i] - mine.value),
                          fmt::format("{:.2g}", mine.deviation)});
  }
  return table;
}

std::string calibration_text(const CalibrationResult& result) {
  std::string text = text_table(summary_of(result));
  for (const ReportTable& table : {parameter_table(result), view_table(result), visp_table(result)})
    if (!table.rows.empty()) text += "\n" + aligned(table);
  for (const Objection& o : result.objections) {
    text += fmt::format("\n{}: {}\n        do: {}\n",
                        o.gravity == Gravity::Refusal ? "REFUSED" : "doubt", o.what, o.remedy);
  }
  return text;
}

}  // namespace kestrel

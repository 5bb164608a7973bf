#include <cmath>

#include <nlohmann/json.hpp>

#include "kestrel/calibration/calibration_table.hpp"

namespace kestrel {
namespace {

using Json = nlohmann::ordered_json;

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json vector_of(const Eigen::Vector3d& v) { return {finite(v.x()), finite(v.y()), finite(v.z())}; }

Json parameters_json(const Calibration& c) {
  Json list = Json::array();
  for (const ParameterEstimate& p : c.parameters) {
    list.push_back({{"name", p.name},
                    {"value", finite(p.value)},
                    {"standard_deviation", finite(p.deviation)},
                    {"unit", p.unit}});
  }
  return list;
}

Json views_json(const Calibration& c) {
  Json list = Json::array();
  for (const SolvedView& view : c.views) {
    Json points = Json::array();
    for (const PointResidual& r : view.residuals)
      points.push_back({finite(r.seen.u), finite(r.seen.v), finite(r.du_px), finite(r.dv_px)});
    list.push_back(
        {{"name", view.name},
         {"rms_px", finite(view.rms_px)},
         {"worst_px", finite(view.worst_px)},
         {"camera_from_board",
          {{"translation_m", vector_of(view.camera_from_board.translation)},
           {"rotation_vector_rad", vector_of(rotation_vector(view.camera_from_board.rotation))}}},
         {"u_v_du_dv_px", points}});
  }
  return list;
}

Json objections_json(const CalibrationResult& result) {
  Json list = Json::array();
  for (const Objection& o : result.objections) {
    list.push_back({{"weight", o.gravity == Gravity::Refusal ? "refusal" : "doubt"},
                    {"what", o.what},
                    {"remedy", o.remedy}});
  }
  return list;
}

Json visp_json(const VispCheck& check) {
  return {{"fx_px", finite(check.visp.px)},
          {"fy_px", finite(check.visp.py)},
          {"cx_px", finite(check.visp.u0)},
          {"cy_px", finite(check.visp.v0)},
          {"kud", finite(check.visp.distortion[0])},
          {"kdu", finite(check.visp.distortion[1])},
          {"rms_px", finite(check.visp_rms_px)},
          {"our_parameters", parameters_json(check.ours)},
          {"largest_standard_deviations", finite(check.largest_deviations)}};
}

}  // namespace

std::string calibration_json(const CalibrationResult& result) {
  Json out{{"board", to_string(result.job.board)},     {"model", name(result.job.model)},
           {"image_width", result.job.size.width},     {"image_height", result.job.size.height},
           {"views_found", result.job.views.size()},   {"coverage", finite(result.coverage.share)},
           {"refused", is_refused(result.objections)}, {"objections", objections_json(result)}};
  const bool solved = result.calibration.has_value();
  out["rms_px"] = solved ? finite(result.calibration->rms_px) : Json(nullptr);
  out["hold_out_rms_px"] = result.hold_out ? finite(result.hold_out->rms_px) : Json(nullptr);
  out["noise_px"] = solved ? finite(result.calibration->noise_px) : Json(nullptr);
  out["parameters"] = solved ? parameters_json(*result.calibration) : Json::array();
  out["visp"] = result.visp ? visp_json(*result.visp) : Json(nullptr);
  out["views"] = solved ? views_json(*result.calibration) : Json::array();
  return out.dump(2) + "\n";
}

}  // namespace kestrel

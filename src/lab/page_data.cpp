#include "kestrel/lab/page_data.hpp"

#include <cmath>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "kestrel/lab/trace_thinning.hpp"

namespace kestrel {
namespace {

using Json = nlohmann::ordered_json;

/// The figures that the page shows as bars.
constexpr const char* kFigures[] = {
    "k_error",          "t_error_s",       "settle_s",         "retreat_m",          "approach_m",
    "path_ratio",       "image_ratio",     "path_m",           "image_deviation_px", "effort",
    "final_position_m", "final_angle_rad", "final_heading_rad"};

std::string text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json rounded(const Eigen::Vector3d& v) {
  Json out = Json::array();
  for (const double x : v)
    out.push_back(std::isfinite(x) ? Json(std::round(x * 1e5) / 1e5) : Json());
  return out;
}

Json frame(const SpaceFrame& one) {
  Json axes = Json::array();
  for (int i = 0; i < 3; ++i) axes.push_back(rounded(one.axes.col(i)));
  return {{"at", rounded(one.origin_m)}, {"axes", axes}};
}

Json scene(const LabScene& one) {
  Json points = Json::array();
  Json goals = Json::array();
  Json limits = Json::object();
  for (const Eigen::Vector3d& p : one.points_m) points.push_back(rounded(p));
  for (const Pixel& p : one.goal_px)
    goals.push_back({std::round(p.u * 10) / 10, std::round(p.v * 10) / 10});
  for (const auto& [column, limit] : one.limits) limits[column] = limit;
  return {{"kind", one.kind == RunKind::Camera ? "camera" : "helicopter"},
          {"points", points},
          {"start", frame(one.start)},
          {"goal", frame(one.goal)},
          {"goal_px", goals},
          {"focal", one.focal_px},
          {"image", {one.width_px, one.height_px}},
          {"limits", limits}};
}

/// Whole units, each less the one before; NaN leaves a null and changes nothing.
std::string coded(const std::vector<double>& values, const std::vector<std::size_t>& rows,
                  double unit) {
  std::string out;
  long long last = 0;
  for (const std::size_t row : rows) {
    if (!out.empty()) out += ',';
    if (!std::isfinite(values[row])) {
      out += "null";
      continue;
    }
    const long long now = std::llround(values[row] / unit);
    out += fmt::format("{}", now - last);
    last = now;
  }
  return out;
}

std::string trace(const RunTrace& one, std::size_t most_rows) {
  const std::vector<double> time_s = one.column("time_s");
  if (time_s.empty()) return "";
  const std::vector<TraceChannel> channels = drawn_channels(one);
  const std::vector<std::size_t> rows = kept_rows(time_s, channels, most_rows);
  std::string columns;
  for (const TraceChannel& channel : channels) {
    columns += fmt::format("{}{}:[{},{}]", columns.empty() ? "" : ",", text(channel.column),
                           channel.resolution, coded(channel.values, rows, channel.resolution));
  }
  return fmt::format(",\"t\":[{}],\"c\":{{{}}}", coded(time_s, rows, 1e-3), columns);
}

std::string figures(const LabRun& run) {
  Json out = Json::object();
  for (const char* name : kFigures) {
    const auto value = figure(run, name);
    if (value && std::isfinite(*value)) out[name] = Json::parse(fmt::format("{:.5g}", *value));
  }
  return out.dump();
}

/// JSON may stand in HTML when nothing in it ends or comments the element.
std::string for_html(std::string json) {
  for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos; at += 6) {
    json.replace(at, 1, "\\u003c");
  }
  return json;
}

}  // namespace

std::string page_data(const LabReport& report, std::size_t most_rows) {
  const LabNames laws = laws_of(report.runs);
  const LabNames scenarios = scenarios_of(report.runs);
  const LabNames modifiers = modifiers_of(report.runs);
  Json scenes = Json::object();
  for (const LabScene& one : report.scenes) scenes[one.scenario] = scene(one);
  std::string out =
      fmt::format("{{\"laws\":{},\"scenarios\":{},\"modifiers\":{},\"scenes\":{},\"runs\":[",
                  text(laws.all()), text(scenarios.all()), text(modifiers.all()), text(scenes));
  for (std::size_t i = 0; i < report.runs.size(); ++i) {
    const LabRun& run = report.runs[i];
    out += fmt::format("{}{{\"s\":{},\"m\":{},\"l\":{},\"end\":{},\"ok\":{},\"k\":{}{}}}",
                       i == 0 ? "\n" : ",\n", scenarios.place(run.scenario),
                       modifiers.place(run.modifier), laws.place(run.law), text(end_words(run)),
                       run.end == RunEnd::Converged, figures(run), trace(run.trace, most_rows));
  }
  return for_html(out + "]}");
}

}  // namespace kestrel

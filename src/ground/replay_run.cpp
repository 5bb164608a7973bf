#include "kestrel/ground/replay_run.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <nlohmann/json.hpp>

#include "kestrel/io/text_file.hpp"

namespace kestrel {
namespace {

using Json = nlohmann::json;

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream from(line);
  for (std::string field; std::getline(from, field, ',');) fields.push_back(field);
  return fields;
}

/// Five digits are more than a curve shows; a long run is read over a radio too.
double rounded(double value) {
  if (!std::isfinite(value) || value == 0) return value;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 4);
  return std::round(value / unit) * unit;
}

template <class Values>
void append(Json& to, const Values& values) {
  for (const double value : values) to.push_back(rounded(value));
}

Json errors_of(const LogRow& row) {
  if (!row.servo) return {};
  Json all{rounded(row.servo->error_norm)};
  append(all, row.servo->error);
  return all;
}

Json command_of(const LogRow& row) {
  if (!row.decision) return {};
  Json all = Json::array();
  append(all, row.decision->sent.vector());
  append(all, row.decision->wanted.vector());
  return all;
}

Json twist_of(const LogRow& row) {
  if (!row.servo) return {};
  Json all = Json::array();
  append(all, row.servo->twist.vector());
  return all;
}

/// The largest place that a row names, px.
Pixel farthest(const LogRow& row) {
  Pixel most{row.window.u + row.window.width, row.window.v + row.window.height};
  for (const auto& outline : {row.corners, row.predicted}) {
    if (!outline) continue;
    for (const Pixel& corner : *outline) {
      most = {std::max(most.u, corner.u), std::max(most.v, corner.v)};
    }
  }
  return most;
}

/// What ground_view says of a flight: the task and the row tell as much.
void add_scene(const Task& task, GroundView& view) {
  const auto& attitude = view.row.attitude;
  if (view.seen) view.seen = levelled(*view.seen, attitude, task.body_from_camera);
  view.scene = flight_scene(task, view.seen, attitude);
  if (attitude) view.horizon = horizon(task.camera, task.body_from_camera, *attitude);
}

}  // namespace

std::vector<double> chain_times_ms(const std::filesystem::path& timing_csv, const LogFile& log) {
  std::vector<double> times_ms(log.rows.size(), std::nan(""));
  if (!std::filesystem::exists(timing_csv)) return times_ms;
  std::istringstream lines(read_text(timing_csv));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = fields_of(line);
  const auto column =
      std::size_t(std::find(names.begin(), names.end(), "chain_ms") - names.begin());
  if (names.empty() || names[0] != "frame" || column == names.size()) {
    throw FileError(timing_csv, 1, "", "has no columns frame and chain_ms; remove the file");
  }
  std::map<std::int64_t, double> of_frame;
  while (std::getline(lines, line)) {
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() != names.size() || fields[column].empty()) continue;  // cut short, or unknown
    of_frame[parse_integer(fields[0])] = parse_number(fields[column]);
  }
  for (std::size_t i = 0; i < log.rows.size(); ++i) {
    const auto it = of_frame.find(log.rows[i].frame);
    if (it != of_frame.end()) times_ms[i] = it->second;
  }
  return times_ms;
}

std::array<int, 2> picture_size_px(const ReplayRun& run) {
  if (run.task && run.task->camera.parameters().width > 0) {
    return {run.task->camera.parameters().width, run.task->camera.parameters().height};
  }
  constexpr double kLargest = 8192;  // an outline seen wrongly may lie anywhere
  Pixel most{640, 480};
  for (const LogRow& row : run.log.rows) {
    const Pixel far = farthest(row);
    if (far.u <= kLargest) most.u = std::max(most.u, far.u);
    if (far.v <= kLargest) most.v = std::max(most.v, far.v);
  }
  return {int(std::ceil(most.u)), int(std::ceil(most.v))};
}

GroundView replay_view(const ReplayRun& run, std::size_t row, const cv::Mat& picture) {
  GroundView view;
  view.row = run.log.rows.at(row);
  const auto size_px = picture_size_px(run);
  view.gray = picture.empty() ? cv::Mat::zeros(size_px[1], size_px[0], CV_8UC1) : picture;
  view.goal_corners.fill({std::nan(""), std::nan("")});
  if (run.task) {
    const std::vector<Feature> desired = desired_features(*run.task);
    for (std::size_t i = 0; i < view.goal_corners.size(); ++i) {
      view.goal_corners[i] = run.task->camera.to_pixel(desired[i].at);
    }
  }
  if (view.row.pose) view.seen = target_pose(*view.row.pose);
  if (run.task) add_scene(*run.task, view);
  const auto matches = run.matches.find(view.row.frame);
  if (matches != run.matches.end()) add_matches(matches->second, view);
  view.chain_ms = run.chain_ms.at(row);
  return view;
}

std::string json(const ReplayRun& run) {
  Json all{{"name", run.name}, {"notes", run.notes}};
  for (const char* column :
       {"stamp_s", "frame", "found", "errors", "twist", "command", "condition", "time"}) {
    all[column] = Json::array();
  }
  for (std::size_t i = 0; i < run.log.rows.size(); ++i) {
    const LogRow& row = run.log.rows[i];
    all["stamp_s"].push_back(row.stamp_s);
    all["frame"].push_back(row.frame);
    all["found"].push_back(row.status == TrackStatus::Found);
    all["errors"].push_back(errors_of(row));
    all["twist"].push_back(twist_of(row));
    all["command"].push_back(command_of(row));
    all["condition"].push_back(row.servo ? Json{rounded(row.servo->condition)} : Json());
    all["time"].push_back(std::isfinite(run.chain_ms[i]) ? Json{rounded(run.chain_ms[i])} : Json());
  }
  return all.dump();
}

}  // namespace kestrel

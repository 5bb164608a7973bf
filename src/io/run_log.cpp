#include "kestrel/io/run_log.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "log_visit.hpp"

namespace kestrel {
namespace {

// Collects the names of the columns.
struct Names {
  std::vector<std::string> names;

  template <class Value>
  void operator()(const char* name, const Value&) {
    names.emplace_back(name);
  }
  template <class Value, class Fields>
  void group(const std::optional<Value>&, Fields fields) {
    const Value any{};
    fields(any, *this);
  }
};

std::string text(double value) { return number(value); }
std::string text(std::int64_t value) { return std::to_string(value); }
std::string text(int value) { return std::to_string(value); }
std::string text(bool value) { return value ? "1" : "0"; }
std::string text(Miss value) { return name(value); }
std::string text(TrackStatus value) { return name(value); }
std::string text(TrackStage value) { return name(value); }
std::string text(CommandState value) { return name(value); }

// Writes the fields of one row.
struct Line {
  std::string line;

  template <class Value>
  void operator()(const char*, const Value& value) {
    line += text(value) + ",";
  }
  template <class Value, class Fields>
  void group(const std::optional<Value>& value, Fields fields) {
    if (value) return fields(*value, *this);
    Names absent;
    absent.group(value, fields);
    line.append(absent.names.size(), ',');
  }
};

std::string extra_header(const std::vector<std::string>& columns) {
  const std::vector<std::string> fixed = log_columns();
  std::set<std::string> taken(fixed.begin(), fixed.end());
  std::string line;
  for (const std::string& column : columns) {
    const bool is_plain =
        !column.empty() &&
        column.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
    if (!is_plain || !taken.insert(column).second)
      throw std::invalid_argument("run log: column '" + column +
                                  "' is taken or not of a-z, 0-9, _; give it another name");
    line += "," + column;
  }
  return line;
}

}  // namespace

std::vector<std::string> log_columns() {
  Names names;
  const LogRow any;
  log_format::visit(any, names);
  return names.names;
}

RunLog::RunLog(const std::filesystem::path& path, const std::vector<std::string>& extra_columns)
    : file_(path), extra_columns_(extra_columns.size()) {
  std::string header;
  for (const std::string& column : log_columns()) header += (header.empty() ? "" : ",") + column;
  file_.write(header + extra_header(extra_columns));
}

void RunLog::write(const LogRow& row) {
  if (row.extra.size() != extra_columns_)
    throw std::invalid_argument("run log: a row has " + std::to_string(row.extra.size()) +
                                " extra values for " + std::to_string(extra_columns_) + " columns");
  Line fields;
  log_format::visit(row, fields);
  fields.line.pop_back();  // the comma after the last field
  for (const double value : row.extra)
    fields.line += "," + (std::isnan(value) ? "" : number(value));
  file_.write(fields.line);
}

CornerNoise corner_noise(const CornerCovariance& covariance) {
  CornerNoise noise;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto u = Eigen::Index(2 * i);
    noise[i] = {covariance(u, u), covariance(u, u + 1), covariance(u + 1, u + 1)};
  }
  return noise;
}

LogRow log_row(const Frame& frame, const Template& model, const Track& track) {
  LogRow row;
  row.frame = frame.index;
  row.stamp_s = frame.stamp_s;
  row.status = track.status;
  row.stage = track.stage;
  row.miss = track.miss;
  row.age_s = track.age_s;
  row.confidence = track.confidence;
  row.alike_share = track.agreement.alike_share();
  row.window = track.window;
  row.keypoints = track.keypoints;
  row.matches = track.matches;
  row.inliers = int(track.inliers.size());
  row.trials = track.trials;
  row.image_from_template = track.image_from_template;
  if (track.found())
    row.corners = outline(*track.image_from_template, model.width(), model.height());
  if (track.predicted) row.predicted = outline(*track.predicted, model.width(), model.height());
  if (track.found() || track.predicted) row.noise = corner_noise(track.corner_covariance);
  row.attitude = frame.attitude;
  return row;
}

LogRow log_row(const Frame& frame, const Template& model, const Step& step) {
  LogRow row = log_row(frame, model, step.track);
  if (step.pose)
    row.pose = LoggedPose{step.pose->camera_from_target.translation,
                          rotation_vector(step.pose->camera_from_target.rotation),
                          step.pose->reprojection_px, step.pose->rival.has_value()};
  const std::optional<Servo>& servo = step.decision.servo;
  if (servo && servo->error.size() == 8) {
    row.servo = LoggedServo{{}, servo->error.norm(), servo->condition, servo->twist};
    std::copy(servo->error.begin(), servo->error.end(), row.servo->error.begin());
  }
  row.decision = LoggedDecision{step.decision.state, step.decision.wanted, step.decision.command};
  return row;
}

}  // namespace kestrel

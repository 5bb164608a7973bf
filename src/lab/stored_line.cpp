#include "stored_line.hpp"

#include <stdexcept>

#include <nlohmann/json.hpp>

namespace kestrel {
namespace {

using Json = nlohmann::ordered_json;

Json metrics_of(const LabRun& run) {
  Json metrics = Json::object();
  for (const auto& [name, value] : run.metrics) {
    metrics[name] = value ? Json(*value) : Json(nullptr);
  }
  return metrics;
}

RunEnd end_of(const std::string& word) {
  const auto end = run_end_named(word);
  if (!end) throw std::runtime_error("unknown end " + word);
  return *end;
}

LawRefusal refusal_of(const std::string& word) {
  for (int i = 0; i <= int(LawRefusal::Unreachable); ++i) {
    if (word == name(LawRefusal(i))) return LawRefusal(i);
  }
  throw std::runtime_error("unknown refusal " + word);
}

StoredLine line_of(const Json& json) {
  StoredLine line;
  LabRun& run = line.stored.run;
  line.stored.inputs = json.at("inputs");
  run.id = json.at("id");
  run.scenario = json.at("scenario");
  run.law = json.at("law");
  run.modifier = json.at("modifier");
  run.kind = json.at("world") == "helicopter" ? RunKind::Helicopter : RunKind::Camera;
  run.end = end_of(json.at("end"));
  run.refusal = refusal_of(json.at("refusal"));
  run.steps = json.at("steps");
  for (const auto& [name, value] : json.at("metrics").items()) {
    run.metrics.emplace_back(name, value.is_null() ? std::nullopt : std::optional<double>(value));
  }
  line.trace_rows = json.at("trace_rows");
  run.law_us = json.value("law_us", 0.0);
  return line;
}

}  // namespace

std::string stored_line(const StoredRun& stored, LineTimes times) {
  const LabRun& run = stored.run;
  Json json;
  json["id"] = run.id;
  json["inputs"] = stored.inputs;
  json["scenario"] = run.scenario;
  json["law"] = run.law;
  json["modifier"] = run.modifier;
  json["world"] = run.kind == RunKind::Helicopter ? "helicopter" : "camera";
  json["end"] = name(run.end);
  json["refusal"] = name(run.refusal);
  json["steps"] = run.steps;
  json["metrics"] = metrics_of(run);
  json["trace_rows"] = run.trace.rows.size();
  if (times == LineTimes::Kept) json["law_us"] = run.law_us;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<StoredLine> read_stored_line(const std::string& line) {
  try {
    return line_of(Json::parse(line));
  } catch (const std::exception&) {  // whatever is wrong with it, the run is made again
    return std::nullopt;
  }
}

}  // namespace kestrel

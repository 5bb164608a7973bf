#include "kestrel/lab/lab_report.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace kestrel {
namespace {

LabNames names_of(const std::vector<LabRun>& runs, std::string LabRun::*part) {
  LabNames names;
  for (const LabRun& run : runs) names.add(run.*part);
  return names;
}

std::string spaced(std::string words) {
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

}  // namespace

std::optional<double> figure(const LabRun& run, const std::string& name) {
  for (const auto& [key, value] : run.metrics) {
    if (key == name) return value;
  }
  return std::nullopt;
}

std::string end_words(const LabRun& run) {
  std::string words = spaced(name(run.end));
  if (run.end != RunEnd::Refused || run.refusal == LawRefusal::None) return words;
  return words + ": " + spaced(name(run.refusal));
}

std::string outcome(const LabRun& run) {
  if (run.end != RunEnd::Converged) return end_words(run);
  if (const auto step = figure(run, "k_error")) return fmt::format("{:.0f}", *step);
  if (const auto time_s = figure(run, "settle_s")) return fmt::format("{:.1f} s", *time_s);
  return end_words(run);
}

int LabNames::add(const std::string& name) {
  const int known = place(name);
  if (known >= 0) return known;
  names_.push_back(name);
  return int(names_.size()) - 1;
}

int LabNames::place(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return found == names_.end() ? -1 : int(found - names_.begin());
}

LabNames laws_of(const std::vector<LabRun>& runs) { return names_of(runs, &LabRun::law); }
LabNames scenarios_of(const std::vector<LabRun>& runs) { return names_of(runs, &LabRun::scenario); }
LabNames modifiers_of(const std::vector<LabRun>& runs) { return names_of(runs, &LabRun::modifier); }

const LabScene* scene_named(const LabReport& report, const std::string& scenario) {
  for (const LabScene& scene : report.scenes) {
    if (scene.scenario == scenario) return &scene;
  }
  return nullptr;
}

}  // namespace kestrel

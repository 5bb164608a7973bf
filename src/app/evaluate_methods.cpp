#include "evaluate_methods.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/eval/track_method.hpp"
#include "kestrel/io/csv.hpp"
#include "kestrel/io/task_options.hpp"

namespace kestrel::app {
namespace {

/// A method of our own: its name, and what it changes of the options.
struct OwnMethod {
  const char* name;
  void (*choose)(TrackOptions& options);
};

constexpr OwnMethod kOwnMethods[] = {
    {"paper", [](TrackOptions& options) { options.method = TrackMethod::Paper; }},
    {"detect", [](TrackOptions& options) { options.method = TrackMethod::Detect; }},
    {"hybrid", [](TrackOptions& options) { options.method = TrackMethod::Hybrid; }},
};

/// A key of the section `track` and a value for it.
using Setting = std::pair<std::string, std::string>;

struct Sweep {
  std::string key;
  std::vector<std::string> values;
};

bool is_plain(const std::string& value) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.+-";
  return !value.empty() && value.find_first_not_of(kPlain) == std::string::npos;
}

Sweep sweep_of(const std::string& text) {
  const auto equals = text.find('=');
  const std::string said = "'" + text + "' ";
  if (equals == std::string::npos || equals == 0) {
    throw std::invalid_argument(said + "is no KEY=VALUE,VALUE,...; write e.g. match.ratio=0.7,0.8");
  }
  Sweep sweep{text.substr(0, equals), {}};
  if (!is_plain(sweep.key)) throw std::invalid_argument(said + "has no plain word as its key");
  for (const std::string_view field : csv_fields(std::string_view(text).substr(equals + 1))) {
    sweep.values.emplace_back(field);
    if (!is_plain(sweep.values.back())) {
      throw std::invalid_argument(said + "has '" + sweep.values.back() +
                                  "' for a value; write numbers or words with commas between");
    }
  }
  return sweep;
}

/// The settings as a task file would write them.
std::string yaml_of(const std::vector<Setting>& settings) {
  std::map<std::string, std::string> sections;
  for (const auto& [key, value] : settings) {
    const auto dot = key.find('.');
    const std::string section = dot == std::string::npos ? "" : key.substr(0, dot);
    std::string& text = sections[section];
    text += (text.empty() ? "" : ", ") + key.substr(dot == std::string::npos ? 0 : dot + 1) + ": " +
            value;
  }
  std::string all;
  for (const auto& [name, text] : sections) {
    if (!all.empty()) all += ", ";
    all += name.empty() ? text : fmt::format("{}: {{{}}}", name, text);
  }
  return "track: {" + all + "}\n";
}

TrackOptions options_of(const std::vector<Setting>& settings) {
  const Section root = Section::parse("--set", yaml_of(settings));
  TrackOptions options = read_track_options(root);
  root.done();
  return options;
}

/// Every combination of values, the last sweep's changing fastest.
std::vector<std::vector<Setting>> combinations(const std::vector<Sweep>& sweeps) {
  std::vector<std::vector<Setting>> all{{}};
  for (const Sweep& sweep : sweeps) {
    std::vector<std::vector<Setting>> longer;
    for (const auto& before : all) {
      for (const std::string& value : sweep.values) {
        longer.push_back(before);
        longer.back().emplace_back(sweep.key, value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

}  // namespace

std::vector<std::string> own_methods() {
  std::vector<std::string> names;
  for (const OwnMethod& method : kOwnMethods) names.emplace_back(method.name);
  return names;
}

std::string setting_fault(const std::string& setting) {
  try {
    const Sweep sweep = sweep_of(setting);
    for (const std::string& value : sweep.values) options_of({{sweep.key, value}});
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

std::vector<BenchMethod> swept_methods(const std::string& method,
                                       const std::vector<std::string>& settings) {
  const auto* own =
      std::find_if(std::begin(kOwnMethods), std::end(kOwnMethods),
                   [&](const OwnMethod& candidate) { return candidate.name == method; });
  if (own == std::end(kOwnMethods)) throw std::invalid_argument(method + ": is no method");
  std::vector<Sweep> sweeps;
  std::set<std::string> keys;
  for (const std::string& text : settings) {
    sweeps.push_back(sweep_of(text));
    if (!keys.insert(sweeps.back().key).second) {
      throw std::invalid_argument("--set: " + sweeps.back().key +
                                  " is given twice; write all its values in one");
    }
  }
  std::vector<BenchMethod> methods;
  for (const std::vector<Setting>& combination : combinations(sweeps)) {
    TrackOptions options = options_of(combination);
    own->choose(options);
    std::string name = method;
    for (const auto& [key, value] : combination) name += fmt::format(" {}={}", key, value);
    methods.push_back(track_method(name, options));
  }
  return methods;
}

}  // namespace kestrel::app

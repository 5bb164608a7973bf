#include "kestrel/lab/lab_plan_file.hpp"

#include <algorithm>
#include <stdexcept>

#include "kestrel/io/mount_file.hpp"
#include "kestrel/io/yaml_section.hpp"
#include "kestrel/lab/benchmark.hpp"

#include "plan_keys.hpp"
#include "plan_parts.hpp"
#include "plan_settings.hpp"

namespace kestrel {
namespace {

constexpr const char* kAll = "all";

std::vector<std::string> names(const std::vector<Scenario>& scenarios) {
  std::vector<std::string> all;
  all.reserve(scenarios.size());
  for (const Scenario& scenario : scenarios) all.push_back(scenario.name);
  return all;
}

PlannedLaw read_law(const Section& section) {
  const std::string word = section.text("law");
  const LawOptions options = benchmark_law(law_of(section, "law", word));
  return {section.text("label", word), read_law_options(section, options)};
}

std::vector<PlannedLaw> read_laws(const Section& root) {
  std::vector<PlannedLaw> laws;
  for (const SectionItem& item : root.items("laws")) {
    if (item.keys) {
      laws.push_back(read_law(*item.keys));
    } else if (item.word == kAll) {
      for (const Law law : all_laws()) laws.push_back({name(law), benchmark_law(law)});
    } else {
      laws.push_back({item.word, benchmark_law(law_of(root, "laws", item.word))});
    }
  }
  return laws;
}

std::vector<Scenario> read_scenarios(const Section& root) {
  std::vector<Scenario> scenarios;
  const std::vector<Scenario>& known = benchmark_scenarios();
  for (const SectionItem& item : root.items("scenarios")) {
    if (item.keys) {
      scenarios.push_back(read_scenario(*item.keys));
    } else if (item.word == kAll) {
      scenarios.insert(scenarios.end(), known.begin(), known.end());
    } else {
      const auto found = std::find_if(known.begin(), known.end(),
                                      [&](const Scenario& s) { return s.name == item.word; });
      if (found == known.end())
        fail_unknown(root, "scenarios", "scenario", item.word, names(known));
      scenarios.push_back(*found);
    }
  }
  return scenarios;
}

RunRules read_rules(const Section& section) {
  RunRules rules;
  read_numbers(section, rule_keys(), rules);
  rules.settled_steps = section.whole("settled_steps", rules.settled_steps);
  rules.stops_out_of_view = section.flag("stops_out_of_view", rules.stops_out_of_view);
  or_fail(section, "", [&] { rules.check(); });
  return rules;
}

template <class Part, class Read>
std::vector<Part> read_list(const Section& root, const std::string& key, Read read) {
  std::vector<Part> parts;
  if (!root.has(key)) return parts;
  for (const SectionItem& item : root.items(key)) {
    if (!item.keys) root.fail(key, "'" + item.word + "' is a word; give keys in braces");
    parts.push_back(read(*item.keys));
  }
  return parts;
}

}  // namespace

LabPlan load_plan(const std::filesystem::path& file) {
  const Section root = Section::load(file);
  LabPlan plan;
  plan.title = root.text("title", file.stem().string());
  plan.trace_every = root.whole("trace_every", plan.trace_every);
  plan.settled_error = root.number("settled_error", plan.settled_error);
  if (root.has("laws")) plan.laws = read_laws(root);
  if (root.has("scenarios")) plan.scenarios = read_scenarios(root);
  if (const auto camera = root.child_if("camera")) plan.camera = read_camera(*camera);
  if (const auto c = root.child_if("conditions")) plan.conditions = read_conditions(*c, {});
  if (const auto rules = root.child_if("rules")) plan.rules = read_rules(*rules);
  plan.modifiers = read_modifiers<Conditions>(root);
  plan.maps = read_list<PlannedMap>(root, "maps", read_map);
  plan.basins = read_list<PlannedBasin>(
      root, "basins", [&](const Section& section) { return read_basin(section, plan); });
  plan.margins = read_list<PlannedMargin>(root, "margins", read_margin);
  plan.orders = read_list<PlannedOrder>(root, "orders", read_order);
  if (const auto h = root.child_if("helicopter"))
    plan.helicopter = read_helicopter(*h, plan.camera);
  root.done();
  or_fail(root, "", [&] { plan.check(); });
  return plan;
}

}  // namespace kestrel

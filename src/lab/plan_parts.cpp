#include "plan_parts.hpp"

#include <algorithm>
#include <cmath>

#include "kestrel/io/csv.hpp"
#include "kestrel/io/mount_file.hpp"
#include "kestrel/lab/lab_plan_file.hpp"

namespace kestrel {
namespace {

TargetPose read_start(const Section& section, const TargetPose& goal) {
  if (section.has("start")) {
    if (section.has("start_in_goal")) {
      section.fail("start", "is given together with start_in_goal; remove one of the two");
    }
    return read_pose<frame::Camera, frame::Target>(section.child("start"));
  }
  const TargetPose read = read_pose<frame::Camera, frame::Target>(section.child("start_in_goal"));
  return GoalFromCamera{read.rotation, read.translation}.inverse() * goal;
}

std::vector<std::string> words_if(const Section& section, const std::string& key) {
  std::vector<std::string> words =
      section.has(key) ? section.words(key) : std::vector<std::string>{};
  if (words == std::vector<std::string>{"all"}) words.clear();
  return words;
}

/// The settings of the section, in the order of condition_keys().
std::vector<ConditionSetting> read_settings(const Section& section) {
  std::vector<ConditionSetting> settings;
  for (const std::string& key : condition_keys()) {
    if (!section.has(key)) continue;
    settings.emplace_back(key, section.number(key));
    or_fail(section, key, [&] { with_setting({}, settings.back()); });
  }
  return settings;
}

/// Every combination of the swept values, the last key's changing fastest.
std::vector<PlannedModifier> swept(const Section& sweep, const PlannedModifier& modifier) {
  std::vector<PlannedModifier> all{modifier};
  for (const std::string& key : sweep.keys()) {
    for (const ConditionSetting& setting : modifier.settings) {
      if (setting.first == key) sweep.fail(key, "is set beside the sweep; remove one of the two");
    }
    std::vector<PlannedModifier> longer;
    for (const PlannedModifier& before : all) {
      for (const double value : sweep.numbers(key)) {
        longer.push_back(before);
        PlannedModifier& now = longer.back();
        now.settings.emplace_back(key, value);
        or_fail(sweep, key, [&] { with_setting({}, now.settings.back()); });
        now.name += (now.name.empty() ? "" : "_") + key + "=" + number(value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::vector<PlannedModifier> read_modifier(const Section& section) {
  PlannedModifier modifier;
  modifier.words = section.text("words", "");
  const bool is_swept = section.has("sweep");
  modifier.name = is_swept ? section.text("name", "") : section.text("name");
  or_fail(section, "words", [&] { modified(Conditions{}, modifier.words); });
  modifier.settings = read_settings(section);
  modifier.scenarios = words_if(section, "on");
  modifier.laws = words_if(section, "laws");
  return is_swept ? swept(section.child("sweep"), modifier) : std::vector{modifier};
}

SweptKey read_axis(const Section& section) {
  return {section.text("key"), section.numbers("values")};
}

}  // namespace

std::vector<Eigen::Vector3d> read_points(const Section& section) {
  if (section.has("square_m")) {
    if (section.has("points_m")) {
      section.fail("square_m", "is given together with points_m; remove one of the two");
    }
    return square_points(section.number("square_m"));
  }
  const std::vector<double> numbers = section.numbers("points_m");
  if (numbers.empty() || numbers.size() % 3 != 0) {
    section.fail("points_m", "are no points; give a list of [x, y, z]");
  }
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  }
  return points;
}

Scenario read_scenario(const Section& section) {
  Scenario scenario;
  scenario.name = section.text("name");
  scenario.points_m = read_points(section);
  scenario.goal = read_pose<frame::Camera, frame::Target>(section.child("goal"));
  scenario.start = read_start(section, scenario.goal);
  or_fail(section, "", [&] { scenario.check(); });
  return scenario;
}

Conditions read_conditions(const Section& section, const Conditions& conditions) {
  Conditions changed = conditions;
  for (const ConditionSetting& setting : read_settings(section)) {
    changed = with_setting(changed, setting);
  }
  using Desired = Conditions::Desired;
  changed.desired = section.choice<Desired>(
      "desired", {{"taught", Desired::Taught}, {"model", Desired::Model}}, changed.desired);
  return changed;
}

std::vector<PlannedModifier> read_modifiers(const Section& root, const std::string& key) {
  std::vector<PlannedModifier> all;
  for (const SectionItem& item : root.items(key)) {
    if (item.keys) {
      for (PlannedModifier& modifier : read_modifier(*item.keys)) {
        all.push_back(std::move(modifier));
      }
    } else {
      or_fail(root, key, [&] { modified(Conditions{}, item.word); });
      all.push_back({item.word, item.word, {}, {}, {}});
    }
  }
  return all;
}

PlannedMap read_map(const Section& section) {
  return {section.text("name"), section.text("scenario"), words_if(section, "laws"),
          read_axis(section.child("x")), read_axis(section.child("y"))};
}

PlannedBasin read_basin(const Section& section, const LabPlan& plan) {
  PlannedBasin basin;
  basin.name = section.text("name");
  basin.scenario = section.text("scenario");
  basin.laws = words_if(section, "laws");
  if (section.has("file")) {
    basin.starts = load_starts(section.path("file"));
    return basin;
  }
  StartBox box;
  if (const auto keys = section.child_if("box")) {
    if (keys->has("half_size_m")) {
      const std::vector<double> half = keys->numbers("half_size_m", 3);
      box.half_size_m = {half[0], half[1], half[2]};
    }
    read_numbers(*keys, box_keys(), box);
  }
  const std::int64_t seed = section.integer("seed", 1);
  const int poses = section.whole("poses", 0);
  if (poses < 1) section.fail("poses", "must be 1 or more, or give a file");
  or_fail(section, "", [&] {
    basin.starts = start_poses(scenario_named(plan, basin.scenario), plan.camera, box,
                               std::uint64_t(seed), poses);
  });
  return basin;
}

PlannedMargin read_margin(const Section& section) {
  return {section.text("scenario"), words_if(section, "laws"), section.flag("gain", true),
          section.flag("delay", true)};
}

}  // namespace kestrel

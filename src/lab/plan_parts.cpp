#include "plan_parts.hpp"

#include "kestrel/io/mount_file.hpp"
#include "kestrel/lab/lab_plan_file.hpp"

#include "plan_settings.hpp"

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

SweptKey read_axis(const Section& section) {
  return {section.text("key"), section.numbers("values")};
}

}  // namespace

std::vector<std::string> words_if(const Section& section, const std::string& key) {
  std::vector<std::string> words =
      section.has(key) ? section.words(key) : std::vector<std::string>{};
  if (words == std::vector<std::string>{"all"}) words.clear();
  return words;
}

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
  for (const ConditionSetting& setting : read_settings<Conditions>(section, condition_keys())) {
    changed = with_setting(changed, setting);
  }
  using Desired = Conditions::Desired;
  changed.desired = section.choice<Desired>(
      "desired", {{"taught", Desired::Taught}, {"model", Desired::Model}}, changed.desired);
  return changed;
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

PlannedOrder read_order(const Section& section) {
  return {section.text("scenario"), words_if(section, "laws")};
}

}  // namespace kestrel

#include "explain.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "kestrel/lab/run_diagnosis.hpp"
#include "kestrel/lab/task_diagnosis.hpp"

#include "recorded_run.hpp"
#include "task_setup.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

/// What was looked at, and under which heading.
struct Diagnosis {
  std::string heading;
  std::vector<Finding> findings;
};

std::vector<Diagnosis> of_run(const ExplainArguments& a) {
  const RecordedRun run = load_run(a.input, a.task);
  const TaskTiming timing{a.rate_hz.value_or(rate_hz(run.log)), a.latency_s};
  std::vector<Diagnosis> all{{"the run", diagnosis(run.log, run.experiment.task)}};
  if (run.log.was_interrupted) {
    all.front().findings.push_back({Weight::Doubt, "log",
                                    "the last line of run.csv has no end and was left out",
                                    "the program was killed there: run it again"});
  }
  all.push_back({"its task", diagnosis(run.experiment.task, timing)});
  return all;
}

std::vector<Diagnosis> of_task(const ExplainArguments& a) {
  const Section root = Section::load(a.input);
  const Experiment experiment = read_experiment(root);
  double rate = 30;
  if (const auto simulation = root.child_if("simulation")) {
    rate = simulation->number("rate_hz", rate);
  } else if (experiment.sequence) {
    rate = rate_hz(experiment);
  }
  return {{"the task", diagnosis(experiment.task, {a.rate_hz.value_or(rate), a.latency_s})}};
}

void print_json(const std::vector<Diagnosis>& all) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const Diagnosis& diagnosis : all) {
    for (const Finding& f : diagnosis.findings) {
      out.push_back({{"of", diagnosis.heading},
                     {"weight", name(f.weight)},
                     {"topic", f.topic},
                     {"what", f.what},
                     {"remedy", f.remedy}});
    }
  }
  fmt::print("{}\n", out.dump(2));
}

void print_text(const std::vector<Diagnosis>& all) {
  for (const Diagnosis& diagnosis : all) {
    fmt::print("{}\n", diagnosis.heading);
    for (const Finding& f : diagnosis.findings) {
      fmt::print("  {:5} {}: {}\n", name(f.weight), f.topic, f.what);
      if (!f.remedy.empty()) fmt::print("        do: {}\n", f.remedy);
    }
  }
}

}  // namespace

void add_explain(CLI::App& app, const std::shared_ptr<ExplainArguments>& a) {
  auto* verb = app.add_subcommand(
      "explain", "Say why a task or a run does not converge, and which gain it may have");
  verb->add_option("INPUT", a->input, "Task file, or run folder of 'servo' or 'simulate'")
      ->required();
  verb->add_option("--task", a->task, "Task file of a run folder, in place of the one it keeps");
  verb->add_option("--rate", a->rate_hz,
                   "Commands per second, Hz (default: the run's, or the source's, or 30)")
      ->check(CLI::Range(0.01, 1000.0));
  verb->add_option("--latency", a->latency_s,
                   "From the capture of an image to its command on the vehicle, s (default 0)")
      ->check(CLI::Range(0.0, 10.0));
  verb->add_flag_callback(
      "--json", [a] { a->printed = Printed::Json; },
      "Print the findings as JSON (default: sentences)");
  verb->footer(
      "fault: explains a run that does not converge; doubt: may be the cause; fine: looked at.");
}

int run(const ExplainArguments& a) {
  const std::vector<Diagnosis> all = is_run_folder(a.input) ? of_run(a) : of_task(a);
  if (a.printed == Printed::Json) {
    print_json(all);
  } else {
    print_text(all);
  }
  return 0;
}

}  // namespace kestrel::app

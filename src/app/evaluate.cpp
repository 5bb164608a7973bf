#include "evaluate.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

#include <opencv2/core/utility.hpp>

#include "kestrel/eval/bench_page.hpp"
#include "kestrel/eval/bench_store.hpp"
#include "kestrel/eval/bench_table.hpp"
#include "kestrel/io/csv.hpp"

#include "evaluate_inputs.hpp"
#include "evaluate_methods.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "this_program.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kConfigurationFile = "configuration.txt";

EvaluationPlan plan_of(const EvaluateArguments& a, const std::vector<BenchMethod>& more) {
  EvaluationPlan plan;
  for (const fs::path& argument : a.inputs) {
    for (EvaluateInput& input : evaluate_inputs(argument)) {
      plan.inputs[input.sequence.name] = std::move(input.files);
      plan.sequences.push_back(std::move(input.sequence));
    }
  }
  const auto is_wanted = [&](const std::string& name) {
    return a.methods.empty() || std::count(a.methods.begin(), a.methods.end(), name) > 0;
  };
  for (const std::string& name : own_methods()) {
    if (!is_wanted(name)) continue;
    for (BenchMethod& method : swept_methods(name, a.settings)) {
      plan.methods.push_back(std::move(method));
    }
  }
  std::copy_if(more.begin(), more.end(), std::back_inserter(plan.methods),
               [&](const BenchMethod& method) { return is_wanted(method.name); });
  plan.inputs[""] = this_program();
  plan.check();
  return plan;
}

std::string configuration(const EvaluationPlan& plan) {
  std::string text = plan.inputs.at("") + "\n\nmethods:\n";
  for (const BenchMethod& method : plan.methods) text += "  " + method.name + '\n';
  text += "\nsequences:\n";
  for (const BenchSequence& sequence : plan.sequences) {
    const PixelBox& box = sequence.template_px;
    text += fmt::format("  {}: template {} x {} px at ({}, {}), {} labelled frames\n",
                        sequence.name, box.width, box.height, box.u, box.v, sequence.truth.size());
  }
  return text;
}

/// Makes the folder, or takes one that an evaluation made.
void claim(const fs::path& folder, const std::string& text) {
  std::error_code error;
  const bool is_strange = fs::is_directory(folder, error) && !fs::is_empty(folder, error) &&
                          !fs::exists(folder / kConfigurationFile, error);
  if (is_strange) {
    throw std::runtime_error(folder.string() +
                             ": is the folder of something else; choose another with --output");
  }
  fs::create_directories(folder, error);
  if (error) {
    throw std::runtime_error(folder.string() + ": cannot create the folder: " + error.message() +
                             "; choose one that can be written with --output");
  }
  write_text(folder / kConfigurationFile, text);
}

/// A finished run in one line.
std::string line(const EvaluationProgress& progress) {
  const BenchRun& run = *progress.run;
  std::string text =
      fmt::format("[{}/{}] {}, {}: ", progress.finished, progress.runs, run.sequence, run.method);
  if (run.end != BenchEnd::Done) return text + name(run.end) + ": " + run.reason;
  const BenchScore score = bench_score(run, {});
  return text + fmt::format("{} of {} frames found", score.found, score.frames);
}

Evaluation run_plan(const EvaluationPlan& plan, const EvaluateArguments& a) {
  const int cores = std::max(1, int(std::thread::hardware_concurrency()));
  Progress progress(std::nullopt);
  const EvaluationHooks hooks{
      thread_cpu_s, interrupted, [&](const EvaluationProgress& now) {
        if (now.run != nullptr) {
          progress.clear();
          fmt::print(stderr, "{}\n", line(now));
        }
        progress.step(now.frames,
                      fmt::format("run {} of {}", std::min(now.finished + 1, now.runs), now.runs));
      }};
  return kestrel::evaluate(plan, {a.output, a.jobs > 0 ? a.jobs : cores, a.earlier}, hooks);
}

void print_tables(const EvaluationPlan& plan, const Evaluation& evaluation) {
  const auto scores = scores_of(plan, evaluation);
  fmt::print("{}", aligned(readable(paper_table(scores))));
  if (plan.sequences.size() > 1) {
    const auto methods = method_scores(scores, evaluation.runs);
    fmt::print("\n{}", aligned(readable(method_time_table(methods))));
  }
}

}  // namespace

int evaluate(const EvaluateArguments& a, const std::vector<BenchMethod>& more) {
  const EvaluationPlan plan = plan_of(a, more);
  const std::string text = configuration(plan);
  claim(a.output, text);
  cv::setNumThreads(1);  // the runs share the cores among themselves
  const Evaluation evaluation = run_plan(plan, a);
  if (evaluation.reused > 0) {
    fmt::print(stderr, "{} of {} runs were finished before\n", evaluation.reused,
               evaluation.planned);
  }
  for (const std::string& remark : remarks(plan, evaluation)) fmt::print(stderr, "{}\n", remark);
  write_results(a.output, plan, evaluation, text);
  print_tables(plan, evaluation);
  fmt::print("\nevaluation: {}\n", (a.output / "report.html").string());
  if (!evaluation.is_complete()) return kInterrupted;
  const bool any_failed =
      std::any_of(evaluation.runs.begin(), evaluation.runs.end(),
                  [](const BenchRun& run) { return run.end == BenchEnd::Failed; });
  return any_failed ? 1 : 0;
}

int run(const EvaluateArguments& arguments) { return evaluate(arguments); }

}  // namespace kestrel::app

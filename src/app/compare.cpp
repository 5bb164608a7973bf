#include "compare.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <thread>

#include <fmt/format.h>

#include "kestrel/lab/lab_plan_file.hpp"

#include "compare_folder.hpp"
#include "compare_run.hpp"
#include "interrupt.hpp"
#include "live_plot.hpp"
#include "progress.hpp"
#include "recorded_run.hpp"
#include "this_program.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

/// How long the rest will take when it goes on like this.
std::string time_left(const LabProgress& now, double elapsed_s) {
  const auto made = double(now.finished - now.reused);
  if (made < 1) return "";
  const double left_s = elapsed_s / made * double(now.planned - now.finished);
  return left_s < 60 ? fmt::format("{:.0f} s left", left_s)
                     : fmt::format("{:.0f} min left", std::ceil(left_s / 60));
}

/// The laws of the runs on scenarios, each once.
std::vector<std::string> laws_of(const std::vector<PlannedRun>& planned) {
  std::vector<std::string> laws;
  for (const PlannedRun& run : planned) {
    if (run.part != LabPart::Table) continue;
    if (std::find(laws.begin(), laws.end(), run.law) == laws.end()) laws.push_back(run.law);
  }
  return laws;
}

/// The jobs, each of which draws what it has made.
std::vector<LabJob> drawn(std::vector<LabJob> jobs, LivePlot& plot) {
  for (LabJob& job : jobs) {
    job.run = [make = std::move(job.run), &plot] {
      LabRun run = make();
      plot.draw(run);
      return run;
    };
  }
  return jobs;
}

/// One with a window: it has one thread.
int jobs_at_a_time(const CompareArguments& a) {
  if (a.plotted == Plotted::Live) return 1;
  return a.jobs > 0 ? a.jobs : std::max(1, int(std::thread::hardware_concurrency()));
}

LabOutcome run_plan(const std::vector<LabJob>& jobs, const CompareArguments& a,
                    const std::filesystem::path& folder) {
  std::size_t planned = 0;
  for (std::size_t i = 0; i < jobs.size(); ++i) planned += a.shard.holds(i);
  Progress progress(std::int64_t(planned), "run");
  const double start_s = monotonic_s();
  const LabHooks hooks{interrupted, [&](const LabProgress& now) {
                         progress.step(std::int64_t(now.finished),
                                       time_left(now, monotonic_s() - start_s));
                       }};
  return run_jobs(jobs, {folder, jobs_at_a_time(a), a.shard, a.earlier}, hooks);
}

void tell(const LabOutcome& outcome, const CompareArguments& a) {
  if (outcome.reused > 0) {
    fmt::print(stderr, "{} of {} runs were finished before\n", outcome.reused, outcome.planned);
  }
  for (const LabFailure& failure : outcome.failures) {
    fmt::print(stderr, "{}: failed: {}\n", failure.id, failure.reason);
  }
  if (a.shard.of > 1) {
    fmt::print(stderr, "shard {}/{}: {} runs; unite the shards with 'kestrel merge'\n",
               a.shard.number, a.shard.of, outcome.planned);
  }
  if (!outcome.is_complete() && outcome.failures.empty()) {
    fmt::print(stderr,
               "interrupted: {} of {} runs are finished; the same command goes on from here\n",
               outcome.finished, outcome.planned);
  }
}

}  // namespace

int run(const CompareArguments& a) {
  if (is_run_folder(a.plan)) return compare_run(a);
  const std::filesystem::path folder =
      a.output.empty() ? std::filesystem::path("runs") / a.plan.stem() : a.output;
  const LabPlan wanted = load_plan(a.plan);
  const LabPlan plan = claim_folder(folder, wanted, plan_text(wanted));
  const std::vector<PlannedRun> planned = planned_runs(plan, this_program(), thread_cpu_s);
  std::unique_ptr<LivePlot> plot;
  if (a.plotted == Plotted::Live) plot = std::make_unique<LivePlot>(laws_of(planned));
  const std::vector<LabJob> jobs = plot ? drawn(jobs_of(planned), *plot) : jobs_of(planned);
  LabOutcome outcome = run_plan(jobs, a, folder);
  tell(outcome, a);
  const std::vector<MadeRun> made = made_runs(planned, std::move(outcome.runs));
  write_results(folder, plan, made);
  print_results(plan, made, a.printed);
  fmt::print(stderr, "comparison: {}\n", folder.string());
  if (!outcome.failures.empty()) return 1;
  return outcome.is_complete() ? 0 : kInterrupted;
}

}  // namespace kestrel::app

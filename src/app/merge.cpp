#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/io/text_file.hpp"
#include "kestrel/lab/lab_plan_file.hpp"

#include "compare.hpp"
#include "compare_folder.hpp"
#include "this_program.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

namespace fs = std::filesystem;

/// The plan's text, which all shards have.
std::string common_text(const std::vector<fs::path>& shards) {
  std::string text = read_text(shards.front() / kPlanFile);
  for (const fs::path& shard : shards) {
    if (read_text(shard / kPlanFile) != text) {
      throw std::runtime_error((shard / kPlanFile).string() + ": is another plan than that of " +
                               shards.front().string() + "; give the shards of one");
    }
  }
  return text;
}

}  // namespace

int run(const MergeArguments& a) {
  const std::string text = common_text(a.shards);
  const LabPlan plan = claim_folder(a.output, load_plan(a.shards.front() / kPlanFile), text);
  const std::vector<PlannedRun> planned = planned_runs(plan, this_program(), thread_cpu_s);
  LabOutcome outcome = merge_shards(jobs_of(planned), a.shards, a.output);
  std::string missing;
  for (std::size_t i = 0; i < planned.size() && missing.empty(); ++i) {
    if (!outcome.runs[i]) missing = planned[i].job.id;
  }
  const std::vector<MadeRun> made = made_runs(planned, std::move(outcome.runs));
  write_results(a.output, plan, made);
  print_results(plan, made, a.printed);
  fmt::print(stderr, "comparison: {}\n", a.output.string());
  if (outcome.is_complete()) return 0;
  fmt::print(stderr,
             "{} of {} runs are in none of the shards, or were made by another program; the first "
             "is {}; 'kestrel compare {} --output {}' makes them\n",
             outcome.planned - outcome.finished, outcome.planned, missing,
             (a.output / kPlanFile).string(), a.output.string());
  return 1;
}

}  // namespace kestrel::app

#include <charconv>

#include <CLI/CLI.hpp>

#include "kestrel/servo/law.hpp"

#include "compare.hpp"

namespace kestrel::app {
namespace {

Shard shard_of(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.number);
  const bool has_slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  const auto second = has_slash ? std::from_chars(first.ptr + 1, end, shard.of) : first;
  const bool is_one = has_slash && second.ec == std::errc() && second.ptr == end;
  if (!is_one || shard.of < 1 || shard.number < 1 || shard.number > shard.of) {
    throw CLI::ValidationError("--shard", "'" + text + "' is not i/n with i from 1 to n, as 2/4");
  }
  return shard;
}

CLI::Validator law_name() {
  return {
      [](std::string& law) { return law_named(law) ? std::string() : "there is no law " + law; },
      "NAME", "law"};
}

}  // namespace

void add_compare(CLI::App& app, const std::shared_ptr<CompareArguments>& a) {
  auto* verb = app.add_subcommand(
      "compare", "Run control laws over scenarios and modifiers, and put them side by side");
  verb->add_option("PLAN", a->plan,
                   "Plan of the comparison (tasks/compare_*.yaml), or the folder of a 'servo' or "
                   "'simulate' run: what would each law have commanded at each of its frames")
      ->required();
  verb->add_option("--laws", a->laws, "Laws for a run folder (default: all)")
      ->delimiter(',')
      ->check(law_name());
  verb->add_option("--task", a->task, "Task file of a run folder, in place of the one it keeps");
  verb->add_option("--output", a->output,
                   "Run folder; one that is there is continued: finished runs of the same program "
                   "and plan are not made again (default runs/<name of the plan>, or laws/ in a "
                   "run folder)");
  verb->add_option("--jobs", a->jobs, "Runs at a time (default: the number of cores)")
      ->check(CLI::Range(1, 1024));
  verb->add_option_function<std::string>(
      "--shard", [a](const std::string& text) { a->shard = shard_of(text); },
      "i/n: make every n-th run only, beginning with the i-th; 'kestrel merge' unites the folders "
      "(default 1/1)");
  verb->add_flag_callback(
      "--fresh", [a] { a->earlier = Earlier::Redone; }, "Make every run again (default: continue)");
  verb->add_flag_callback(
      "--plot", [a] { a->plotted = Plotted::Live; },
      "Draw each run in a window (ViSP's vpPlot) as soon as it is made, one run at a time "
      "(default: no window)");
  verb->add_flag_callback(
      "--json", [a] { a->printed = Printed::Json; },
      "Print results.json on standard output (default: tables)");
  verb->footer(
      "Numbers in the tables: the step from which |e| (normalised image plane) stays below the "
      "threshold; words: how the run ended.\nThe folder holds results.csv, results.json, "
      "table.txt, runs/ (a trace each), basins.csv, maps/, margins.csv, orders.csv, timing.csv "
      "and configuration.yaml. tasks/compare.md has every key of a plan and every file.");
}

void add_merge(CLI::App& app, const std::shared_ptr<MergeArguments>& a) {
  auto* verb = app.add_subcommand("merge", "Unite the folders of 'compare --shard'");
  verb->add_option("OUTPUT", a->output, "Run folder to make")->required();
  verb->add_option("SHARDS", a->shards, "Folders of the shards, all of one plan")->required();
  verb->add_flag_callback(
      "--json", [a] { a->printed = Printed::Json; },
      "Print results.json on standard output (default: tables)");
}

void add_laws(CLI::App& app, const std::shared_ptr<LawsArguments>& a) {
  auto* verb = app.add_subcommand("laws", "Say which control laws there are and what they need");
  verb->add_option("LAW", a->law, "One law, in full (default: all, one line each)")
      ->check(law_name());
}

}  // namespace kestrel::app

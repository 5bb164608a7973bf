#include "kestrel/eval/bench_page.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "kestrel/eval/bench_table.hpp"
#include "kestrel/io/csv.hpp"

#include "bench_sections.hpp"

namespace kestrel {
namespace {

const BenchSequence& sequence_of(const EvaluationPlan& plan, const BenchRun& run) {
  return *std::find_if(plan.sequences.begin(), plan.sequences.end(),
                       [&](const BenchSequence& s) { return s.name == run.sequence; });
}

/// How hard a sequence is: the mean area of its methods, large for easy; the ones without labels at
/// the end.
double ease(const SequencePart& part) {
  constexpr double kEasiest = 2;
  double sum = 0;
  int count = 0;
  for (const BenchScore& score : part.scores) {
    if (!score.is_judged) continue;
    sum += score.metrics.area_10px;
    ++count;
  }
  return count > 0 ? sum / count : kEasiest;
}

/// The runs by sequence, hardest first.
std::vector<SequencePart> parts_of(const EvaluationPlan& plan, const Evaluation& evaluation) {
  std::vector<SequencePart> parts;
  for (const BenchSequence& sequence : plan.sequences) {
    SequencePart part{&sequence, {}, {}};
    for (const BenchRun& run : evaluation.runs) {
      if (run.sequence != sequence.name) continue;
      part.runs.push_back(run);
      part.scores.push_back(bench_score(run, sequence.truth));
    }
    if (!part.runs.empty()) parts.push_back(std::move(part));
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const SequencePart& a, const SequencePart& b) { return ease(a) < ease(b); });
  return parts;
}

/// Puts the runs of a sequence in the order of the methods.
void sort_runs(SequencePart& part, const std::vector<MethodScore>& methods) {
  SequencePart sorted{part.sequence, {}, {}};
  for (const MethodScore& method : methods) {
    for (std::size_t i = 0; i < part.runs.size(); ++i) {
      if (part.runs[i].method != method.method) continue;
      sorted.runs.push_back(std::move(part.runs[i]));
      sorted.scores.push_back(std::move(part.scores[i]));
    }
  }
  part = std::move(sorted);
}

Summary overview(const EvaluationPlan& plan, const Evaluation& evaluation,
                 const std::vector<MethodScore>& methods) {
  Summary s;
  s.begin_section("evaluation");
  s.add("sequences", int(plan.sequences.size()));
  s.add("methods and settings", int(plan.methods.size()));
  s.add("runs finished", int(evaluation.runs.size()), fmt::format("of {}", evaluation.planned));
  std::int64_t frames = 0;
  for (const BenchRun& run : evaluation.runs) frames += std::int64_t(run.frames.size());
  s.add("frames tracked", frames);
  if (methods.empty() || methods.front().judged == 0) return s;
  const MethodScore& best = methods.front();
  s.begin_section("best method");
  s.add("name", best.method);
  s.add("within 5 px", 100 * best.within_5px, "%");
  s.add("area to 10 px", 100 * best.area_10px, "%");
  s.add("wrong", best.wrong, fmt::format("of {}", best.labelled));
  if (best.time_s) s.add("median time", best.time_s->median * 1e3, "ms");
  return s;
}

/// What is to be said of the labels of a sequence; empty for nothing.
std::string label_remark(const BenchSequence& sequence, const BenchRun& run) {
  if (sequence.truth.empty()) {
    return sequence.name + ": has no labels; its runs are scored by the frames found only";
  }
  if (run.end == BenchEnd::Done && judged_by(sequence.truth, run).empty()) {
    return fmt::format(
        "{}: its labels have no row for frame {}, where the template is learned; its runs are "
        "scored by the frames found only",
        sequence.name, run.frames.empty() ? 0 : run.frames.front().frame);
  }
  return "";
}

}  // namespace

std::vector<BenchScore> scores_of(const EvaluationPlan& plan, const Evaluation& evaluation) {
  std::vector<BenchScore> scores;
  scores.reserve(evaluation.runs.size());
  for (const BenchRun& run : evaluation.runs) {
    scores.push_back(bench_score(run, sequence_of(plan, run).truth));
  }
  return scores;
}

std::vector<std::string> remarks(const EvaluationPlan& plan, const Evaluation& evaluation) {
  std::vector<std::string> all;
  const auto say = [&](const std::string& sentence) {
    const bool is_new = std::find(all.begin(), all.end(), sentence) == all.end();
    if (!sentence.empty() && is_new) all.push_back(sentence);
  };
  if (!evaluation.is_complete()) {
    say(fmt::format(
        "interrupted: {} of {} runs are finished; the same command again makes the others",
        evaluation.runs.size(), evaluation.planned));
  }
  for (const BenchRun& run : evaluation.runs) {
    if (run.end != BenchEnd::Done) {
      say(fmt::format("{}, {}: {}: {}", run.sequence, run.method, name(run.end), run.reason));
    }
    say(label_remark(sequence_of(plan, run), run));
    for (const std::string& skipped : run.skipped) say(run.sequence + ": skipped " + skipped);
  }
  return all;
}

Report bench_report(const EvaluationPlan& plan, const Evaluation& evaluation,
                    const std::string& configuration) {
  const auto methods = method_scores(scores_of(plan, evaluation), evaluation.runs);
  std::vector<SequencePart> parts = parts_of(plan, evaluation);
  for (SequencePart& part : parts) sort_runs(part, methods);
  Report report;
  report.title = "Kestrel: evaluation";
  report.what =
      "Each method learned the template in the first frame of each sequence and looked for it in "
      "every frame. The error of a frame is the mean distance of its four labelled corners from "
      "where the reported homography puts them.";
  report.warnings = remarks(plan, evaluation);
  report.summary = overview(plan, evaluation, methods);
  report.sections.push_back(methods_section(methods, parts));
  report.sections.push_back(runs_section(parts));
  for (const SequencePart& part : parts) {
    report.sections.push_back(sequence_section(part, methods));
  }
  report.files = {{"summary.csv", "all scores, a row a run"},
                  {"summary.json", "the same and the methods over all sequences"},
                  {"times.csv", "processor times, a row a run"},
                  {"runs/", "a folder for each run: every frame's answer, error and time"}};
  report.configuration = configuration;
  return report;
}

void write_results(const std::filesystem::path& folder, const EvaluationPlan& plan,
                   const Evaluation& evaluation, const std::string& configuration) {
  const std::vector<BenchScore> scores = scores_of(plan, evaluation);
  write_text(folder / "summary.csv", csv(run_table(scores)));
  write_text(folder / "summary.json", summary_json(scores, method_scores(scores, evaluation.runs)));
  write_text(folder / "times.csv", csv(time_table(scores)));
  write_text(folder / "report.html", report_html(bench_report(plan, evaluation, configuration)));
}

}  // namespace kestrel

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kestrel/eval/bench_score.hpp"
#include "kestrel/eval/evaluation.hpp"
#include "kestrel/io/report.hpp"

namespace kestrel {

/// The score of each run, in their order.
std::vector<BenchScore> scores_of(const EvaluationPlan& plan, const Evaluation& evaluation);

/// What a reader must know before the numbers: runs that are missing, were refused or failed,
/// sequences without usable labels, frames that could not be decoded. A sentence each.
std::vector<std::string> remarks(const EvaluationPlan& plan, const Evaluation& evaluation);

/// The page of an evaluation: methods best first, sequences hardest first, precision curves, times,
/// error over time, worst frames. configuration: what was asked for, as text.
Report bench_report(const EvaluationPlan& plan, const Evaluation& evaluation,
                    const std::string& configuration);

/// Writes summary.csv and summary.json (which depend on the machine in nothing), times.csv and
/// report.html. Throws std::runtime_error with path, cause and remedy.
void write_results(const std::filesystem::path& folder, const EvaluationPlan& plan,
                   const Evaluation& evaluation, const std::string& configuration);

}  // namespace kestrel

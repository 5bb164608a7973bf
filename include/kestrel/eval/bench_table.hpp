#pragma once

#include <string>
#include <vector>

#include "kestrel/eval/bench_score.hpp"
#include "kestrel/eval/table.hpp"

namespace kestrel {

/// A name "METHOD KEY=VALUE ..." cut at its first space: what runs, and with which settings.
struct MethodName {
  std::string method;
  std::string settings;
};
MethodName method_name(const std::string& name);

/// The scores of runs, a row each; doc/evaluate.md says what each column means. Nothing in it
/// depends on the machine. Each key of the settings has a column of its own behind them.
Table run_table(const std::vector<BenchScore>& scores);

/// The times of runs: the method's to learn the template, and its frames'.
Table time_table(const std::vector<BenchScore>& scores);

/// The methods over all sequences, without times and with them.
Table method_table(const std::vector<MethodScore>& methods);
Table method_time_table(const std::vector<MethodScore>& methods);

/// Table I of the paper: mean window, mean keypoints, mean matches, share of correct projections,
/// mean time; with the median, 95 % and longest time, and the share of found frames that are wrong.
Table paper_table(const std::vector<BenchScore>& scores);

/// Runs and methods as one JSON object.
std::string summary_json(const std::vector<BenchScore>& scores,
                         const std::vector<MethodScore>& methods);

}  // namespace kestrel

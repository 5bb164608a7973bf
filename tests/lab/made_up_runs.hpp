#pragma once

#include <atomic>
#include <limits>
#include <string>
#include <vector>

#include "kestrel/lab/lab_runner.hpp"

namespace kestrel::test {

/// A run with two figures and a trace of three rows that are told apart by `value`.
inline LabRun made_up_run(const std::string& scenario, const std::string& law, double value) {
  LabRun run;
  run.scenario = scenario;
  run.law = law;
  run.id = scenario + "/" + law;
  run.end = RunEnd::Converged;
  run.steps = 3;
  run.metrics = {{"k_error", 7 * value},
                 {"first_out_of_view", std::nullopt},
                 {"condition", std::numeric_limits<double>::infinity()}};
  run.trace.columns = {"step", "time_s", "error_norm"};
  for (int k = 0; k < 3; ++k) {
    run.trace.rows.push_back({double(k), k / 3., k == 1 ? std::nan("") : value / 3});
  }
  return run;
}

/// Jobs that make made-up runs and count how many were made.
inline std::vector<LabJob> made_up_jobs(int count, std::atomic<int>* made) {
  std::vector<LabJob> jobs;
  for (int i = 0; i < count; ++i) {
    const LabRun run = made_up_run("S" + std::to_string(i / 3), "law" + std::to_string(i % 3), i);
    jobs.push_back({run.id, "inputs of " + run.id, [run, made] {
                      ++*made;
                      return run;
                    }});
  }
  return jobs;
}

}  // namespace kestrel::test

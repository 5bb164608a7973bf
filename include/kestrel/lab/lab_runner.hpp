#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/eval/evaluation.hpp"
#include "kestrel/lab/lab_run.hpp"

namespace kestrel {

/// One run to be made.
struct LabJob {
  std::string id;               // unique; that of the run
  std::string inputs;           // everything the result depends on, as text
  std::function<LabRun()> run;  // from any thread
};

/// Which of the jobs are made: those at index with index mod of = number - 1.
struct Shard {
  int number = 1;  // 1 .. of
  int of = 1;

  /// Throws std::invalid_argument when it is none.
  void check() const;
  bool holds(std::size_t index) const { return index % std::size_t(of) == std::size_t(number - 1); }
};

struct LabRunnerOptions {
  std::filesystem::path folder;  // of a LabStore
  int jobs = 1;                  // threads that run, >= 1
  Shard shard{};
  Earlier earlier = Earlier::Used;
};

/// How far the runs are.
struct LabProgress {
  std::size_t planned = 0;   // of this shard
  std::size_t finished = 0;  // of these, those of earlier starts included
  std::size_t reused = 0;    // of the finished ones, those of earlier starts
};

/// What the runner needs from outside; tell is called by one thread at a time.
struct LabHooks {
  std::function<bool()> is_interrupted;
  std::function<void(const LabProgress&)> tell;
};

/// A job that threw instead of giving a run.
struct LabFailure {
  std::string id;
  std::string reason;
};

/// What came of the jobs.
struct LabOutcome {
  std::vector<std::optional<LabRun>> runs;  // by the index of the job; empty: not made
  std::vector<LabFailure> failures;         // in the order of the jobs
  std::size_t planned = 0;                  // of this shard
  std::size_t finished = 0;
  std::size_t reused = 0;
  bool is_complete() const { return finished == planned; }
};

/// Makes what the folder does not hold yet, several runs at a time, and keeps each as soon as it is
/// finished; ends early when interrupted. The outcome and the folder (timing.csv apart) do not
/// depend on the number of threads nor on how often it was interrupted. A job that throws is a
/// failure; the others go on. Throws what the store throws (LabStore::keep), and
/// std::invalid_argument for options out of range or an id given twice.
LabOutcome run_jobs(const std::vector<LabJob>& jobs, const LabRunnerOptions& options,
                    const LabHooks& hooks);

/// Unites the folders of shards in options' folder, where all that they hold of the jobs is sealed
/// as run_jobs would have; makes no run. Throws as run_jobs.
LabOutcome merge_shards(const std::vector<LabJob>& jobs,
                        const std::vector<std::filesystem::path>& shards,
                        const std::filesystem::path& folder);

}  // namespace kestrel

#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "kestrel/eval/bench_run.hpp"

namespace kestrel {

/// Every method over every sequence.
struct EvaluationPlan {
  std::vector<BenchSequence> sequences;
  std::vector<BenchMethod> methods;
  /// What the results depend on besides labels and rectangles, by the name of a sequence or method
  /// ("" for all of them): its files, its settings, the program. A run that was kept under other
  /// inputs is made again.
  std::map<std::string, std::string> inputs;

  /// Throws std::invalid_argument that names what is wrong: nothing to run, a name given twice.
  void check() const;
};

/// Whether finished runs of an earlier evaluation count.
enum class Earlier { Used, Redone };

struct EvaluationOptions {
  std::filesystem::path folder;  // the runs are kept in its folder "runs"
  int jobs = 1;                  // threads that run, >= 1
  Earlier earlier = Earlier::Used;
};

/// How far an evaluation is.
struct EvaluationProgress {
  std::size_t runs = 0;           // in the plan
  std::size_t finished = 0;       // of these, those of earlier evaluations included
  std::size_t reused = 0;         // of the finished ones, those of earlier evaluations
  std::int64_t frames = 0;        // done by this evaluation
  const BenchRun* run = nullptr;  // the one that has just been finished, if any
};

/// What an evaluation needs from outside. tell is called by one thread at a time, the others from
/// all of them.
struct EvaluationHooks {
  std::function<double()> thread_clock_s;
  std::function<bool()> is_interrupted;
  std::function<void(const EvaluationProgress&)> tell;
};

/// What was finished: runs in the order of the plan, sequence by sequence.
struct Evaluation {
  std::vector<BenchRun> runs;
  std::size_t planned = 0;
  std::size_t reused = 0;
  bool is_complete() const { return runs.size() == planned; }
};

/// Runs what has not been run before, several runs at a time, and keeps each as soon as it is
/// finished. The result does not depend on the number of threads, times apart. Failed runs are
/// kept out of the store, so that they are tried again. Ends early when interrupted. Throws what
/// the store throws, and std::invalid_argument for a plan or options out of range.
Evaluation evaluate(const EvaluationPlan& plan, const EvaluationOptions& options,
                    const EvaluationHooks& hooks);

}  // namespace kestrel

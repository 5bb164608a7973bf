#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "kestrel/lab/camera_run.hpp"
#include "kestrel/lab/lab_run.hpp"

/// What experiments with a free camera and with a helicopter have in common.
namespace kestrel {

/// Keeps the first row of a trace, every n-th and the last; none for n = 0.
template <class Step>
class TraceRecorder {
 public:
  using Row = std::function<std::vector<double>(const Step&)>;

  TraceRecorder(int every, Row row) : every_(every), row_(std::move(row)) {}

  /// Takes the steps in order; they are counted from 0.
  void add(const Step& step) {
    if (every_ == 0) return;
    is_kept_ = count_++ % every_ == 0;
    if (is_kept_) {
      rows_.push_back(row_(step));
    } else {
      last_ = step;
    }
  }

  std::vector<std::vector<double>> rows() const {
    std::vector<std::vector<double>> all = rows_;
    if (!is_kept_) all.push_back(row_(last_));
    return all;
  }

 private:
  int every_;
  Row row_;
  int count_ = 0;
  bool is_kept_ = true;
  Step last_{};
  std::vector<std::vector<double>> rows_;
};

/// The run under the experiment's labels, with its end and what the law took.
template <class Experiment>
LabRun labelled(const Experiment& experiment, RunKind kind, const RunResult& result) {
  LabRun run;
  run.id = experiment.id();
  run.scenario = experiment.scenario;
  run.law = experiment.law;
  run.modifier = experiment.modifier;
  run.kind = kind;
  run.end = result.end;
  run.refusal = result.refusal;
  run.steps = result.steps;
  run.law_us = result.steps > 0 ? 1e6 * result.law_s / result.steps : 0;
  return run;
}

}  // namespace kestrel

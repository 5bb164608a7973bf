#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kestrel/lab/run_end.hpp"
#include "kestrel/servo/control_law.hpp"

namespace kestrel {

/// A run as a table: fixed column names with units, a row for each step that was kept.
struct RunTrace {
  std::vector<std::string> columns;       // "step", "time_s" first
  std::vector<std::vector<double>> rows;  // as many values as columns; NaN: no value

  /// The values of one column, row by row; empty when there is no such column.
  std::vector<double> column(const std::string& name) const;
};

/// What kind of world a run was in.
enum class RunKind { Camera, Helicopter };

/// One finished run: what was run, how it ended, its figures and its trace. Only law_us depends on
/// the machine.
struct LabRun {
  std::string id;        // "S3_rz90/cur/kz2": unique in a plan, also a path below the run folder
  std::string scenario;  // "S3_rz90"
  std::string law;       // label of the law: its name, or that of a variant of its options
  std::string modifier;  // "" or e.g. "kz2", "d3_l8"
  RunKind kind = RunKind::Camera;
  RunEnd end = RunEnd::TimedOut;
  LawRefusal refusal = LawRefusal::None;
  int steps = 0;
  /// Figures in the order of run_metrics.hpp (helicopter_metrics.hpp); empty: it has none.
  std::vector<std::pair<std::string, std::optional<double>>> metrics;
  RunTrace trace;
  double law_us = 0;  // processor time of the law, mean of a step, microseconds
};

}  // namespace kestrel

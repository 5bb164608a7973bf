#pragma once

#include <string>
#include <vector>

#include "kestrel/lab/lab_run.hpp"

namespace kestrel::app {

struct PlotModule;
struct ShownPlots;

/// A window (ViSP's vpPlot) in which each run of a comparison is drawn as soon as it is made: the
/// laws of one scenario over each other, a new picture for the next one. For one thread.
class LivePlot {
 public:
  /// laws: one curve each. Throws std::runtime_error without a display.
  explicit LivePlot(std::vector<std::string> laws);
  ~LivePlot();
  LivePlot(const LivePlot&) = delete;
  LivePlot& operator=(const LivePlot&) = delete;

  /// Draws error, speed, turn rate (of a helicopter: error, position error, commanded speed) and
  /// condition number of a run's trace.
  void draw(const LabRun& run);

 private:
  const PlotModule& module_;
  std::vector<std::string> laws_;
  ShownPlots* plots_;
  std::string shown_;  // scenario and modifier that are being drawn
};

}  // namespace kestrel::app

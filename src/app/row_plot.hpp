#pragma once

#include <optional>

#include <opencv2/core/types.hpp>

#include "kestrel/io/run_log.hpp"

namespace kestrel::app {

struct PlotModule;
struct ShownPlots;

/// A window of curves (ViSP's vpPlot) that grow with a run: of one that servoes feature errors,
/// camera twist, command and condition number, of one that only tracks corners, their deviation,
/// confidence and counts. Five points a second, a minute at a time, so that a long run is no
/// burden. For one thread.
class RowPlot {
 public:
  /// Opens nothing yet. pictures: the size of those shown at the screen's corner; the curves come
  /// beside them, or below when they are wide.
  explicit RowPlot(cv::Size pictures);
  ~RowPlot();
  RowPlot(const RowPlot&) = delete;
  RowPlot& operator=(const RowPlot&) = delete;

  /// Draws what a row has to show; the first one opens the window and tells what kind of run it is.
  /// Throws std::runtime_error without a display.
  void draw(const LogRow& row);

 private:
  void open(const LogRow& row);

  const PlotModule& module_;
  cv::Size pictures_;
  bool servoes_ = false;
  ShownPlots* plots_ = nullptr;
  std::optional<double> began_s_;  // the minute that is shown
  double drawn_s_ = 0;
};

}  // namespace kestrel::app

#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/io/contact_sheet.hpp"
#include "kestrel/io/match_log.hpp"
#include "kestrel/io/report.hpp"
#include "kestrel/io/run_figures.hpp"
#include "kestrel/io/run_log.hpp"
#include "kestrel/io/timing_log.hpp"
#include "kestrel/io/video_writer.hpp"

#include "arguments.hpp"
#include "display.hpp"
#include "row_plot.hpp"

namespace kestrel::app {

/// What a run wants recorded.
struct RecorderOptions {
  std::filesystem::path folder;  // wanted; see create_run_folder
  double rate_hz = 30;           // of the video
  bool video = true;
  bool display = false;
  std::string hint;  // of what the mouse does in the window
  std::vector<std::string> extra_columns;
  std::string configuration;  // text of the effective configuration
  std::string configuration_name = "configuration.yaml";
  std::filesystem::path task;  // where the configuration was read from; empty: nowhere
};

/// Times of one frame's stages, ms.
struct StageTimes {
  double source_ms = 0;  // until the frame was there
  double chain_ms = 0;   // from the frame to the command
  double record_ms = 0;  // log, overlay, video
};

/// The value below which this share (0 to 1) of the values lies; NaN when there is none.
double quantile(std::vector<double> values, double share);

/// The run folder while it grows: run.csv, matches.csv and timing.csv row by row, the video frame
/// by frame, so that an interrupted run keeps all it has done; summary and report at the end.
class RunRecorder {
 public:
  explicit RunRecorder(const RecorderOptions& options);

  const std::filesystem::path& folder() const { return folder_; }

  /// Records a frame, whose picture is drawn only if it is kept or shown. badness: larger is a
  /// worse frame (for the contact sheet). What the mouse did in the window.
  Click record(const LogRow& row, const Track& track, const std::function<cv::Mat()>& draw,
               double badness, StageTimes times);

  /// Waits until the mouse is clicked in the window, or Ctrl-C: then it is the right one.
  Click wait_for_click();

  /// Writes summary.json, report.html and closes the video. The report's video, pictures, files and
  /// configuration are filled in here.
  void finish(Report report);

  /// Median and 95th percentile of the chain's time so far, ms, and their frames per second.
  void add_times(Summary& summary) const;

 private:
  RecorderOptions options_;
  std::filesystem::path folder_;
  RunLog log_;
  MatchLog matches_;
  TimingLog timing_;
  std::unique_ptr<VideoWriter> video_;
  std::unique_ptr<Window> window_;
  std::unique_ptr<RowPlot> plot_;
  ContactSheet sheet_;
  std::vector<double> chain_ms_;
};

}  // namespace kestrel::app

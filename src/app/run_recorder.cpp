#include "run_recorder.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include <fmt/format.h>

#include "kestrel/io/csv.hpp"
#include "kestrel/io/run_folder.hpp"

#include "interrupt.hpp"
#include "progress.hpp"
#include "recorded_run.hpp"

namespace kestrel::app {
namespace {

constexpr int kEvenPictures = 6;
constexpr int kWorstPictures = 3;

const std::vector<ReportFile>& file_words() {
  static const std::vector<ReportFile> words = {
      {"run.csv", "one row a frame: what was seen, decided and sent"},
      {"matches.csv", "keypoints of the frames in which some were matched"},
      {"timing.csv", "processing times of each frame, ms"},
      {"wire.csv", "when each command left, and how old its frame was"},
      {"truth.csv", "where the helicopter really was, at each frame"},
      {"run.mp4", "annotated video"},
      {"run.avi", "annotated video"},
      {"summary.json", "the table at the top, for programs"},
      {"commands.csv", "the commands as the receiver got them"},
      {"trajectory.tum", "true path of the helicopter: time, position, quaternion (NED)"},
      {"configuration.yaml", "the task as it was read"},
      {kOriginFile, "where it was read from: its paths are relative to that place"},
      {"report.html", "this page"},
  };
  return words;
}

/// Before a folder is made for a run that cannot be shown.
RecorderOptions showable(const RecorderOptions& options) {
  if (options.display) require_display();
  return options;
}

}  // namespace

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  const auto place = std::size_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(place), values.end());
  return values[place];
}

RunRecorder::RunRecorder(const RecorderOptions& options)
    : options_(showable(options)),
      folder_(create_run_folder(options.folder)),
      log_(folder_ / "run.csv", options.extra_columns),
      matches_(folder_ / "matches.csv"),
      timing_(folder_ / "timing.csv", {"source", "chain", "record"}),
      sheet_(kEvenPictures, kWorstPictures) {
  if (options.video) video_ = std::make_unique<VideoWriter>(folder_ / "run.mp4", options.rate_hz);
  if (!options.configuration.empty()) {
    write_text(folder_ / options.configuration_name, options.configuration);
  }
  if (!options.task.empty()) {
    write_text(folder_ / kOriginFile, std::filesystem::absolute(options.task).string() + "\n");
  }
}

Click RunRecorder::record(const LogRow& row, const Track& track,
                          const std::function<cv::Mat()>& draw, double badness, StageTimes times) {
  const double start_s = monotonic_s();
  log_.write(row);
  matches_.write(row.frame, track);
  cv::Mat picture;
  const auto drawn = [&] {
    if (picture.empty()) picture = draw();
    return picture;
  };
  if (video_) video_->write(drawn());
  sheet_.offer(drawn, fmt::format("frame {}", row.frame), badness);
  Click click = Click::None;
  if (options_.display) {
    drawn();
    if (!window_) {
      window_ = std::make_unique<Window>(picture.cols, picture.rows, "Kestrel");
      plot_ = std::make_unique<RowPlot>(picture.size());
    }
    plot_->draw(row);
    click = window_->show(picture, options_.hint);
  }
  times.record_ms += (monotonic_s() - start_s) * 1e3;
  timing_.write(row.frame, {times.source_ms, times.chain_ms, times.record_ms});
  chain_ms_.push_back(times.chain_ms);
  return click;
}

Click RunRecorder::wait_for_click() {
  while (window_ && !interrupted()) {
    const Click click = window_->click();
    if (click != Click::None) return click;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return Click::Right;
}

void RunRecorder::add_times(Summary& summary) const {
  if (chain_ms_.empty()) return;
  summary.add("chain time, median", quantile(chain_ms_, 0.5), "ms");
  summary.add("chain time, 95 %", quantile(chain_ms_, 0.95), "ms");
  summary.add("chain time, maximum", quantile(chain_ms_, 1.0), "ms");
}

void RunRecorder::finish(Report report) {
  if (video_) {
    video_->close();
    if (video_->frames() > 0) report.video = video_->path().filename().string();
  }
  write_summary(folder_ / "summary.json", report.summary);
  report.pictures = sheet_.pictures();
  report.configuration = options_.configuration;
  write_text(folder_ / "report.html", "");  // so that the page lists itself
  report.files = files_of(folder_, file_words());
  write_text(folder_ / "report.html", report_html(report));
}

}  // namespace kestrel::app

#include "task_setup.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/io/camera_file.hpp"
#include "kestrel/io/gray_image.hpp"
#include "kestrel/io/sequence.hpp"
#include "kestrel/io/sequence_file.hpp"
#include "kestrel/io/source_address.hpp"
#include "kestrel/io/text_file.hpp"
#include "kestrel/vision/straight_template.hpp"

#include "simulated_camera.hpp"

namespace kestrel::app {
namespace {

/// The text of an optional file; empty when none was given.
std::string text_of(const std::filesystem::path& file) {
  return file.empty() ? std::string() : read_text(file);
}

}  // namespace

RecorderOptions recorder_options(const RunArguments& run, const std::filesystem::path& task,
                                 double rate_hz, const std::vector<std::string>& extra_columns) {
  RecorderOptions options;
  options.folder = run.output.empty() ? std::filesystem::path("runs") / task.stem() : run.output;
  options.rate_hz = rate_hz;
  options.video = run.video;
  options.display = run.display;
  options.hint = "left click: start, stop; right click: end";
  options.extra_columns = extra_columns;
  options.configuration = text_of(task);
  options.task = task;
  return options;
}

void finish_run(RunRecorder& recorder, const Template& model, const Task& task, const ChainEnd& end,
                const Summary& summary, const std::string& title, Sections sections,
                const std::vector<ReportSection>& more) {
  RunView view;
  view.image_width = task.camera.parameters().width;
  view.image_height = task.camera.parameters().height;
  view.goal_corners = goal_corners(model, task);
  view.limits = task.limits;
  Report report;
  report.title = title;
  report.what = fmt::format(
      "Each frame: keypoints in the window, homography, pose, servo law ({}, "
      "gain {} 1/s), command in the heading frame.",
      name(task.servo.law), task.servo.gain_per_s);
  report.warnings = end.skipped;
  if (end.broken) report.warnings.insert(report.warnings.begin(), end.reason);
  report.summary = summary;
  report.sections = sections(read_log(recorder.folder() / "run.csv"), view);
  report.sections.insert(report.sections.end(), more.begin(), more.end());
  recorder.finish(std::move(report));
}

void print_result(const RunResult& result) {
  fmt::print("{}\nrun folder: {}\n", text_table(result.summary), result.folder.string());
}

void override_source(Experiment& experiment, const std::string& text) {
  SourceAddress source;
  try {
    source = parse_source(text);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("--source ") + error.what());
  }
  experiment.source = text;
  experiment.sequence.reset();
  if (source.kind == SourceKind::Sequence) {
    const SequenceDescription description = load_sequence(source.place);
    experiment.sequence = description.sequence;
    experiment.template_px = description.template_px;
  }
  if (source.kind == SourceKind::Images || source.kind == SourceKind::Video) {
    experiment.sequence = SequenceOptions{};
    experiment.sequence->input = source.place;
  }
}

std::unique_ptr<FrameSource> open_source(const Experiment& experiment) {
  if (experiment.sequence) return open_sequence(*experiment.sequence);
  if (experiment.source == "simulation") {
    throw FileError(experiment.file, 0, "source",
                    "is the simulation; fly it with 'kestrel simulate', or give --source");
  }
  return open_camera(experiment.source, experiment.live);
}

void add_source(Summary& summary, const FrameSource& source) {
  const auto status = live_status(source);
  if (!status) return;
  summary.begin_section("camera");
  summary.add("pictures", status->captured);
  summary.add("not taken in time", status->dropped);
  summary.add("lost on the way", status->lost);
  summary.add("damaged", status->damaged);
  summary.add("connections", status->connections);
  summary.add("longest silence", status->longest_silence_s, "s");
  summary.add("stamped by", status->clock == CaptureClock::Driver ? "its driver" : "the arrival");
}

double rate_hz(const Experiment& experiment) {
  constexpr double kUnknownRate = 30;
  if (!experiment.sequence) return kUnknownRate;
  return experiment.sequence->rate_hz.value_or(kUnknownRate);
}

Frame first_frame(FrameSource& source, const std::string& source_name) {
  std::optional<Frame> first = source.next();
  if (first) return std::move(*first);
  std::string why = source_name + ": gives no frame";
  if (!source.skipped().empty()) why += "; " + source.skipped().front();
  throw std::runtime_error(why);
}

Tracker learn_template(const Experiment& experiment, const Frame& first) {
  const TrackOptions& track = experiment.task.track;
  if (experiment.template_image) {
    const cv::Mat picture = load_gray(*experiment.template_image);
    const PixelBox all{0, 0, double(picture.cols), double(picture.rows)};
    return {picture, experiment.template_px.value_or(all), track};
  }
  const PixelBox box = experiment.template_px ? *experiment.template_px : ask_rectangle(first);
  return {straight_template(first.gray, box, experiment.task.camera), box, track};
}

PixelBox ask_rectangle(const Frame& first) {
  if (!has_display()) {
    throw std::runtime_error(
        "no template: give its rectangle (template_px in the task, --roi x,y,w,h for track); there "
        "is no display to draw it on");
  }
  const auto drawn = select_rectangle(first.gray, "Kestrel: select the template");
  if (!drawn) throw std::runtime_error("no template: the selection was given up");
  fmt::print(stderr, "template: --roi {:.0f},{:.0f},{:.0f},{:.0f}\n", drawn->u, drawn->v,
             drawn->width, drawn->height);
  return *drawn;
}

}  // namespace kestrel::app

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "kestrel/eval/track_metrics.hpp"
#include "kestrel/io/camera_file.hpp"
#include "kestrel/io/overlay.hpp"
#include "kestrel/io/truth_file.hpp"
#include "kestrel/vision/straight_template.hpp"
#include "kestrel/vision/tracker.hpp"

#include "ground.hpp"
#include "interrupt.hpp"
#include "pacer.hpp"
#include "progress.hpp"
#include "task_setup.hpp"
#include "track_job.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

/// Where the pose comes from, when the camera and the target's size are known.
struct PoseSetup {
  Camera camera;
  PlaneSize size;
};

std::optional<Camera> camera_of(const TrackJob& job, const Frame& first) {
  if (job.camera.empty()) return std::nullopt;
  const Camera camera = load_camera(job.camera, job.camera_name);
  require_resolution(camera, first.gray.cols, first.gray.rows, job.camera);
  return camera;
}

std::optional<PoseSetup> pose_setup(const TrackJob& job, const std::optional<Camera>& camera,
                                    const Template& model) {
  if (!camera || job.size_m.size() != 2) return std::nullopt;
  return PoseSetup{*camera, {model.width(), model.height(), job.size_m[0], job.size_m[1]}};
}

Tracker learned(const TrackJob& job, const Frame& first, TrackOptions options,
                const std::optional<Camera>& camera) {
  const PixelBox box = job.roi ? *job.roi : ask_rectangle(first);
  if (!camera || camera->parameters().lens == Lens::Pinhole) return {first.gray, box, options};
  options.lens = camera;
  return {straight_template(first.gray, box, *camera), box, options};
}

/// Distance of this frame's outline from the truth, px; NaN without truth or answer.
double error_px(const TrackTruth& truth, std::int64_t frame,
                const std::optional<Homography>& estimate) {
  const auto row = truth.find(frame);
  if (row == truth.end() || !estimate) return std::nan("");
  TrackTruth pair{{truth.begin()->first, truth.begin()->second}, {frame, row->second}};
  const auto scores = frame_scores(pair, {{frame, estimate}});
  return scores.back().error_px.value_or(std::nan(""));
}

/// Runs the tracker over the frames and keeps what the summary needs.
class TrackRun {
 public:
  TrackRun(Tracker& tracker, const std::optional<PoseSetup>& pose, TrackTruth truth,
           RunRecorder& recorder, OnlookerGround& ground)
      : tracker_(tracker),
        model_(tracker.model()),
        template_from_first_{tracker.learned_place().H.inverse()},
        pose_setup_(pose),
        truth_(std::move(truth)),
        recorder_(recorder),
        ground_(ground) {}

  void start(const Frame& first) { state_ = tracker_.start(first.gray.cols, first.gray.rows); }

  /// False once the user has closed the window. A left click there holds what it shows until the
  /// next one.
  bool frame(const Frame& frame, double source_ms) {
    const double start_s = monotonic_s();
    const Track seen = tracker_.track(frame, state_);
    LogRow row = log_row(frame, model_, seen);
    add_pose(seen, row);
    const double chain_ms = (monotonic_s() - start_s) * 1e3;
    state_ = seen.next;
    std::optional<Homography> estimate;
    if (seen.found()) estimate = Homography{seen.image_from_template->H * template_from_first_};
    estimates_[frame.index] = estimate;
    row.extra = {error_px(truth_, frame.index, estimate)};
    count(seen);
    ground_.show(frame, row, seen, chain_ms);
    const double badness = seen.found() ? row.extra[0] : 1e6;
    const auto draw = [&] { return overlay(frame, model_, seen); };
    Click click = recorder_.record(row, seen, draw, badness, {source_ms, chain_ms, 0});
    if (click == Click::Left) click = recorder_.wait_for_click();
    return click != Click::Right;
  }

  Summary summary(const FrameSource& source, const std::string& ended_by) const {
    Summary s;
    s.begin_section("tracker");
    s.add("frames", frames_);
    s.add("frames skipped", std::int64_t(source.skipped().size()));
    s.add("found", frames_ > 0 ? 100.0 * double(found_) / double(frames_) : 0.0, "%");
    s.add("mean confidence", mean(confidence_));
    s.add("coasting", frames_ > 0 ? 100.0 * double(coasting_) / double(frames_) : 0.0, "%");
    s.add("mean keypoints", mean(keypoints_));
    s.add("mean matches", mean(matches_));
    s.add("mean inliers", mean(inliers_));
    s.add("ended by", ended_by);
    if (!truth_.empty()) add_truth(s);
    return s;
  }

  std::int64_t frames() const { return frames_; }

 private:
  void add_pose(const Track& seen, LogRow& row) {
    if (!pose_setup_ || !seen.found()) return;
    const PlaneSize& size = pose_setup_->size;
    const auto view = straight_view(seen, size.width_px, size.height_px, pose_setup_->camera);
    if (!view) return;
    const auto pose = plane_pose(view->image_from_template, size, view->camera, last_pose_);
    if (!pose) return;
    last_pose_ = pose->camera_from_target;
    row.pose = LoggedPose{last_pose_->translation, rotation_vector(last_pose_->rotation),
                          pose->reprojection_px, pose->rival.has_value()};
  }

  void count(const Track& seen) {
    ++frames_;
    found_ += seen.found() ? 1 : 0;
    coasting_ += seen.status == TrackStatus::Coasting ? 1 : 0;
    confidence_ += seen.confidence;
    keypoints_ += seen.keypoints;
    matches_ += seen.matches;
    inliers_ += double(seen.inliers.size());
  }

  double mean(double sum) const { return frames_ > 0 ? sum / double(frames_) : 0; }

  void add_truth(Summary& s) const {
    const TrackMetrics m = track_metrics(truth_, estimates_);
    s.begin_section("against truth");
    s.add("labelled frames", m.labelled);
    s.add("within 5 px", m.within_5px * 100, "%");
    s.add("within 1 px", m.within_1px * 100, "%");
    s.add("wrong (found, over 10 px off)", m.wrong);
    s.add("corner error, median", m.median_px.value_or(std::nan("")), "px");
    s.add("corner error, 95 %", m.p95_px.value_or(std::nan("")), "px");
    s.add("corner error, maximum", m.max_px.value_or(std::nan("")), "px");
    s.add("longest gap", m.longest_gap, "frames");
    s.add("recoveries", m.recoveries);
  }

  Tracker& tracker_;
  const Template& model_;
  const Eigen::Matrix3d template_from_first_;
  std::optional<PoseSetup> pose_setup_;
  TrackTruth truth_;
  RunRecorder& recorder_;
  OnlookerGround& ground_;
  TrackState state_;
  std::optional<TargetPose> last_pose_;
  TrackEstimate estimates_;
  std::int64_t frames_ = 0;
  std::int64_t found_ = 0;
  std::int64_t coasting_ = 0;
  double confidence_ = 0;
  double keypoints_ = 0;
  double matches_ = 0;
  double inliers_ = 0;
};

/// The next frame with an image: nobody flies here who must hear that the camera is silent.
std::optional<Frame> next_image(FrameSource& source) {
  std::optional<Frame> next = source.next();
  while (next && !has_image(*next) && !interrupted()) next = source.next();
  return next && has_image(*next) ? std::move(next) : std::nullopt;
}

/// Folds the tracker over the frames; the reason why it ended.
std::string fold(TrackRun& job, FrameSource& source, Pacer pacer, Frame frame) {
  Progress progress(source.frame_count());
  std::size_t told = 0;
  double source_ms = 0;
  while (true) {
    pacer.wait_for(frame.stamp_s);
    if (!job.frame(frame, source_ms)) return "the window was closed";
    if (interrupted()) return "interrupted";
    progress.step(job.frames(), "");
    const double ask_s = monotonic_s();
    std::optional<Frame> next = next_image(source);
    source_ms = (monotonic_s() - ask_s) * 1e3;
    for (; told < source.skipped().size(); ++told) {
      fmt::print(stderr, "skipped: {}\n", source.skipped()[told]);
    }
    if (!next) return interrupted() ? "interrupted" : "end of the frames";
    frame = std::move(*next);
  }
}

}  // namespace

int run(const TrackArguments& a) {
  const TrackJob job = track_job(a);
  const auto source = open_source(job);
  const Frame first = first_frame(*source, a.input);
  TrackOptions options;
  options.method = a.method;
  const auto camera = camera_of(job, first);
  Tracker tracker = learned(job, first, options, camera);
  const auto pose = pose_setup(job, camera, tracker.model());
  const TrackTruth truth = job.truth.empty() ? TrackTruth{} : TrackTruth(load_truth(job.truth));
  RecorderOptions wanted =
      recorder_options(a.run, {}, job.sequence.rate_hz.value_or(30), {"corner_error_px"});
  if (a.run.output.empty()) wanted.folder = default_folder(a.input);
  wanted.hint = "left click: hold, go on; right click: end";
  OnlookerGround ground(a.ground, "nothing flies here: track only looks");
  RunRecorder recorder(wanted);
  TrackRun tracking(tracker, pose, truth, recorder, ground);
  tracking.start(first);
  // What is live has its own pace, and what is watched is of a human's.
  const bool is_watched_recording = (ground.is_there() || a.run.display) && job.live.empty();
  const Pacer pacer(is_watched_recording ? Pace::RealTime : Pace::AsFastAsPossible);
  const std::string ended_by = fold(tracking, *source, pacer, first);
  RunResult result{recorder.folder(), tracking.summary(*source, ended_by), 0};
  recorder.add_times(result.summary);
  result.summary.add("peak memory", peak_memory_mb(), "MB");
  add_source(result.summary, *source);
  RunView view;
  view.image_width = first.gray.cols;
  view.image_height = first.gray.rows;
  Report report;
  report.title = "Track: " + a.input;
  report.what = "Where the template was found in each frame.";
  report.warnings = source->skipped();
  report.summary = result.summary;
  report.sections = track_sections(read_log(recorder.folder() / "run.csv"), view);
  recorder.finish(std::move(report));
  print_result(result);
  return interrupted() ? kInterrupted : 0;
}

}  // namespace kestrel::app

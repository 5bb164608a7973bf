#include "chain.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <opencv2/core.hpp>

#include "kestrel/io/overlay.hpp"

#include "interrupt.hpp"
#include "pacer.hpp"
#include "progress.hpp"

namespace kestrel::app {
namespace {

/// A frame of the run is worse the less is known: lost frames first, then large reprojection.
/// One without an image shows nothing.
double badness(const Frame& frame, const Step& step) {
  if (!has_image(frame)) return 0;
  if (!step.track.found()) return 1e6;
  return step.pose ? step.pose->reprojection_px : 1e3;
}

/// The fold over the frames and what it carries.
class Fold {
 public:
  Fold(const Chain& chain, const Watch& watch, Frame first)
      : chain_(chain),
        watch_(watch),
        frame_(std::move(first)),
        pacer_(chain.pace),
        progress_(chain.source.frame_count()),
        task_(chain.task),
        state_(start(chain.tracker, frame_)) {
    drawn_.goal_corners = goal_corners(chain.tracker.model(), task_);
  }

  /// Takes the frame down the chain, then records it; false when the run has come to its end.
  bool frame() {
    pacer_.wait_for(frame_.stamp_s);
    const double start_s = monotonic_s();
    if (!frame_.attitude && chain_.attitude) frame_.attitude = chain_.attitude(frame_.stamp_s);
    if (chain_.ground && has_image(frame_)) take_course();  // a new template starts in a picture
    std::optional<Eigen::Vector3d> velocity_m_s;
    if (chain_.velocity) velocity_m_s = chain_.velocity(frame_.stamp_s);
    Step now = step(chain_.tracker, frame_, state_, task_, velocity_m_s);
    steer(now);
    chain_.sink.send(now.decision.command, command_stamp_s(now.decision));
    const double chain_ms = (monotonic_s() - start_s) * 1e3;
    take_time(now);
    if (chain_.ground && has_image(frame_)) {
      GroundView view = ground_view(frame_, now, chain_.tracker.model(), task_, chain_ms);
      if (chain_.age_s) view.latency_ms = end_.latencies_s.back() * 1e3;
      chain_.ground->show(std::move(view));
    }
    LogRow row = log_row(frame_, chain_.tracker.model(), now);
    const auto reason = watch_(frame_, now, row);
    drawn_.sent = FailsafeCommand{now.decision.command, now.decision.state};
    const auto draw = [&] { return picture_of(now); };
    const Click click = chain_.recorder.record(row, now.track, draw, badness(frame_, now),
                                               {source_ms_, chain_ms, 0});
    count(now);
    progress_.step(end_.frames, name(now.decision.state));
    state_ = now.next;
    end_.last = std::move(now);
    if (reason) end_.reason = *reason;
    obey(click);
    if (interrupted()) end_.reason = "interrupted";
    return end_.reason.empty();
  }

  /// Fetches the next frame; false at the end of the source.
  bool next() {
    const double ask_s = monotonic_s();
    std::optional<Frame> next = chain_.source.next();
    source_ms_ = (monotonic_s() - ask_s) * 1e3;
    const auto& skipped = chain_.source.skipped();
    for (; told_ < skipped.size(); ++told_) fmt::print(stderr, "skipped: {}\n", skipped[told_]);
    if (next) frame_ = std::move(*next);
    if (!next) end_.reason = "end of the frames";
    return next.has_value();
  }

  void broke(const std::string& why) {
    end_.broken = true;
    end_.reason = why;
  }

  /// Hover is the last word, whatever happened, also of a hand that holds the sticks.
  ChainEnd end() {
    if (chain_.ground) chain_.ground->desk().handle(GroundCommand{}, monotonic_s());
    chain_.sink.send(VelocityCommand::hover(), frame_.stamp_s);
    end_.skipped = chain_.source.skipped();
    return end_;
  }

 private:
  /// While the source is silent, zeros are decided anew, and so is what a hand asks for, which
  /// rests on no picture; a command that fades is as old as the last picture, and no sink may take
  /// it for younger.
  double command_stamp_s(const Decision& decision) const {
    const bool fades =
        decision.state != CommandState::Hover && decision.state != CommandState::Sticks;
    const bool is_old = !has_image(frame_) && fades && !decision.command.vector().isZero(0);
    return is_old ? seen_stamp_s_ : frame_.stamp_s;
  }

  /// What the operator has changed since the frame before.
  void take_course() {
    std::optional<Course> course = chain_.ground->desk().course();
    if (!course) return;
    if (course->task.servo.law != task_.servo.law) {  // what the one has learned is not the other's
      state_.decision.law = LawState{};
      state_.decision.law_since_s.reset();
    }
    task_ = std::move(course->task);
    if (course->tracker) {
      chain_.tracker = std::move(*course->tracker);
      state_ = start(chain_.tracker, frame_);
    }
    drawn_.goal_corners = goal_corners(chain_.tracker.model(), task_);
  }

  /// What the operator makes of the decision.
  void steer(Step& now) const {
    if (!chain_.steered && flies_) return;
    if (chain_.steered) {
      now.decision = chain_.steered(std::move(now.decision), state_.decision);
    }
    if (!flies_) now.decision = stopped(std::move(now.decision));
    now.next.decision = now.decision.next;
  }

  /// What the mouse in the window asks for.
  void obey(Click click) {
    if (chain_.start == Start::Paused && end_.frames == 1 && click == Click::None) {
      click = chain_.recorder.wait_for_click();
      pacer_ = Pacer(chain_.pace);
    }
    if (click == Click::Right) end_.reason = "the window was closed";
    if (click != Click::Left) return;
    if (chain_.ground) {
      GroundCommand hover;
      hover.ask = Ask::Hover;
      chain_.ground->desk().handle(hover, monotonic_s());
    } else if (chain_.start != Start::AtOnce) {
      flies_ = !flies_;
      fmt::print(stderr, "{} at {:.2f} s\n", flies_ ? "servoing" : "hover", frame_.stamp_s);
    }
  }

  cv::Mat picture_of(const Step& now) const {
    Frame shown = frame_;
    if (shown.gray.empty()) shown.gray = cv::Mat::zeros(size_, CV_8UC1);
    cv::Mat drawn = overlay(shown, chain_.tracker.model(), now.track, drawn_);
    if (!chain_.beside) return drawn;
    cv::Mat both;
    cv::hconcat(chain_.beside(frame_, drawn.size()), drawn, both);
    return both;
  }

  /// The latency of this frame's command; what the next frames know of it.
  void take_time(Step& now) {
    if (!chain_.age_s || !has_image(frame_)) return;
    end_.latencies_s.push_back(chain_.age_s(frame_.stamp_s));
    LoopTiming& timing = now.next.decision.timing;
    timing = with_latency(timing, end_.latencies_s.back());
  }

  void count(const Step& now) {
    ++end_.frames;
    end_.by_hand += now.decision.state == CommandState::Sticks ? 1 : 0;
    if (!has_image(frame_)) {
      ++end_.blind;
      return;
    }
    seen_stamp_s_ = frame_.stamp_s;
    size_ = frame_.gray.size();
    end_.found += now.track.found() ? 1 : 0;
    end_.servoed += now.decision.servo ? 1 : 0;
    end_.predicted += now.decision.predicted_s > 0 ? 1 : 0;
    if (const auto gain = now.decision.gain_per_s) {
      end_.least_gain_per_s = std::min(*gain, end_.least_gain_per_s.value_or(*gain));
    }
  }

  const Chain& chain_;
  const Watch& watch_;
  Frame frame_;
  Pacer pacer_;
  Progress progress_;
  OverlayOptions drawn_;
  Task task_;  // as the operator has changed it
  bool flies_ = chain_.start == Start::AtOnce;
  LoopState state_;
  ChainEnd end_;
  double source_ms_ = 0;
  double seen_stamp_s_ = 0;  // of the last frame with an image
  cv::Size size_{320, 240};  // of its image
  std::size_t told_ = 0;
};

}  // namespace

std::array<Pixel, 4> goal_corners(const Template& model, const Task& task) {
  const auto points =
      corners_in_target({model.width(), model.height(), task.target_width_m, task.target_height_m});
  std::array<Pixel, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = task.goal * points[i];
    corners[i] = task.camera.to_pixel({p.x() / p.z(), p.y() / p.z()});
  }
  return corners;
}

ChainEnd run_chain(const Chain& chain, Frame frame, const Watch& watch) {
  Fold fold(chain, watch, std::move(frame));
  try {
    while (fold.frame() && fold.next()) {
    }
  } catch (const std::exception& error) {
    fold.broke(error.what());
  }
  return fold.end();
}

void add_chain(Summary& summary, const ChainEnd& end, const CommandSink& sink) {
  const double share = end.frames > 0 ? 100.0 / double(end.frames) : 0;
  summary.add("frames", end.frames);
  summary.add("frames skipped", std::int64_t(end.skipped.size()));
  summary.add("found", double(end.found) * share, "%");
  summary.add("servoed", double(end.servoed) * share, "%");
  if (end.by_hand > 0) summary.add("flown by hand", double(end.by_hand) * share, "%");
  if (end.blind > 0) summary.add("without a picture", end.blind);
  summary.add("commands not sent", std::int64_t(sink.failures()));
  summary.add("ended by", end.reason);
}

void add_timing(Summary& summary, const ChainEnd& end, const Task& task) {
  const LoopTiming& timing = end.last.next.decision.timing;
  summary.begin_section("timing");
  if (timing.period_s) summary.add("period", *timing.period_s * 1e3, "ms");
  summary.add("capture to command, median", quantile(end.latencies_s, 0.5) * 1e3, "ms");
  summary.add("capture to command, 95 %", quantile(end.latencies_s, 0.95) * 1e3, "ms");
  summary.add("capture to command, maximum", quantile(end.latencies_s, 1.0) * 1e3, "ms");
  const double share = end.frames > 0 ? 100.0 / double(end.frames) : 0;
  summary.add("features predicted over it", double(end.predicted) * share, "%");
  const auto largest = largest_gain_per_s(timing, task.timing);
  summary.add("largest gain for this timing", largest.value_or(std::nan("")), "1/s");
  summary.add("least gain used", end.least_gain_per_s.value_or(task.servo.gain_per_s), "1/s");
}

}  // namespace kestrel::app

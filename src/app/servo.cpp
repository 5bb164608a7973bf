#include "servo.hpp"

#include <memory>

#include "kestrel/io/camera_file.hpp"
#include "kestrel/io/live_source.hpp"
#include "kestrel/io/wire_log.hpp"

#include "autopilot_file.hpp"
#include "chain.hpp"
#include "ground.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "simulated_task.hpp"
#include "sinks.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

/// True when the task leaves the template to the simulation whose camera is looked through.
bool learns_at_goal(const Experiment& experiment, const std::optional<Simulation>& simulation) {
  const bool simulated = experiment.source.rfind("sim:", 0) == 0;
  return simulated && simulation && !experiment.template_image && !experiment.template_px;
}

/// As `simulate` learns it, or from the task's picture or rectangle.
LearnedTask learned(const Experiment& experiment, const std::optional<Simulation>& simulation,
                    const Frame& first) {
  const Task& task = experiment.task;
  if (!learns_at_goal(experiment, simulation)) return {task, learn_template(experiment, first)};
  return learned_at_goal(task,
                         scene_of(simulation->scene, task.target_width_m, task.target_height_m));
}

/// The command line's, and what the task adds to it.
GroundArguments with_task(GroundArguments ground, const Experiment& experiment) {
  if (!ground.link.empty()) return ground;
  ground.link = experiment.ground_link;
  if (ground.link_key.empty()) ground.link_key = experiment.ground_link_key;
  return ground;
}

/// Takes over what the sink tells of the times of its commands.
void note_times(const Sink& sink, WireLog* log) {
  if (log == nullptr) return;
  for (const WireTime& time : sink.take_times()) log->write(time);
}

Summary summarise(const ChainEnd& end, const Sink& sink, const FrameSource& source,
                  const Task& task) {
  Summary summary;
  summary.begin_section("chain");
  add_chain(summary, end, *sink.commands);
  if (end.last.decision.servo) {
    summary.add("final feature error", end.last.decision.servo->error.norm());
  }
  add_source(summary, source);
  if (!end.latencies_s.empty()) add_timing(summary, end, task);
  if (sink.report) sink.report(summary);
  return summary;
}

}  // namespace

RunResult servo(const ServoArguments& a) {
  Section file = Section::load(a.task);
  Experiment experiment = read_experiment(file);
  std::optional<Simulation> simulation;  // of interest to who looks through its camera only
  if (const auto section = file.child_if("simulation")) simulation = read_simulation(*section);
  const AutopilotOptions autopilot = read_autopilot(file);
  file.done();
  if (!a.source.empty()) override_source(experiment, a.source);
  if (!a.sink.empty()) experiment.sink = a.sink;

  const auto source = open_source(experiment);
  const std::optional<double> origin_s = stamp_origin_s(*source);
  const Sink sink = open_sink(experiment.sink, autopilot, origin_s);
  const Frame first = first_frame(*source, experiment.source);
  require_resolution(experiment.task.camera, first.gray.cols, first.gray.rows,
                     experiment.camera_file.value_or(a.task));
  LearnedTask learned_task = learned(experiment, simulation, first);
  Ground ground(with_task(a.ground, experiment), learned_task.task, *sink.commands,
                sink.facts);  // a taken port leaves no folder
  RunRecorder recorder(recorder_options(a.run, a.task, rate_hz(experiment), {}));
  std::unique_ptr<WireLog> times;
  if (sink.take_times) times = std::make_unique<WireLog>(recorder.folder() / "wire.csv");
  const auto watch = [&](const Frame&, const Step&, LogRow&) -> std::optional<std::string> {
    note_times(sink, times.get());
    return std::nullopt;
  };
  const bool is_watched_recording =
      (a.ground.port || a.run.display) && !origin_s;  // what is live has its own pace
  Chain chain{*source,           ground.sink(), learned_task.tracker,
              learned_task.task, recorder,      is_watched_recording ? Pace::RealTime : a.pace,
              sink.attitude};
  chain.ground = ground.station();
  chain.steered = ground.steering();
  if (a.run.display && !chain.ground) chain.start = origin_s ? Start::ByClick : Start::Paused;
  if (origin_s) {
    chain.age_s = [zero_s = *origin_s](double stamp_s) { return monotonic_s() - zero_s - stamp_s; };
  }
  const ChainEnd end = run_chain(chain, first, watch);
  RunResult result{recorder.folder(), summarise(end, sink, *source, learned_task.task),
                   end.broken ? 1 : 0};
  recorder.add_times(result.summary);
  note_times(sink, times.get());
  std::vector<ReportSection> more;
  if (times) more.push_back(wire_section(times->times()));
  finish_run(recorder, learned_task.tracker.model(), learned_task.task, end, result.summary,
             "Servo run: " + a.task.stem().string(), servo_sections, more);
  if (interrupted()) result.exit_code = kInterrupted;
  return result;
}

int run(const ServoArguments& arguments) {
  ServoArguments at_terminal = arguments;
  at_terminal.ground.keys = true;
  const RunResult result = servo(at_terminal);
  print_result(result);
  return result.exit_code;
}

}  // namespace kestrel::app

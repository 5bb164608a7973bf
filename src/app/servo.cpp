#include "servo.hpp"

#include "kestrel/io/camera_file.hpp"
#include "kestrel/io/live_camera.hpp"

#include "autopilot_file.hpp"
#include "chain.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "simulation_file.hpp"
#include "sinks.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

Summary summarise(const ChainEnd& end, const Sink& sink, const Task& task) {
  Summary summary;
  summary.begin_section("chain");
  add_chain(summary, end, *sink.commands);
  if (end.last.decision.servo) {
    summary.add("final feature error", end.last.decision.servo->error.norm());
  }
  if (!end.latencies_s.empty()) add_timing(summary, end, task);
  if (sink.report) sink.report(summary);
  return summary;
}

}  // namespace

RunResult servo(const ServoArguments& a) {
  Section file = Section::load(a.task);
  Experiment experiment = read_experiment(file);
  if (const auto section = file.child_if("simulation")) read_simulation(*section);  // not for us
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
  Tracker tracker = learn_template(experiment, first);
  RunRecorder recorder(recorder_options(a.run, a.task, rate_hz(experiment), {}));
  const auto watch = [](const Frame&, const Step&, LogRow&) { return std::nullopt; };
  Chain chain{*source, *sink.commands, tracker, experiment.task, recorder, a.pace, sink.attitude};
  if (origin_s) {
    chain.age_s = [zero = *origin_s](double stamp_s) { return monotonic_s() - zero - stamp_s; };
  }
  const ChainEnd end = run_chain(chain, first, watch);
  RunResult result{recorder.folder(), summarise(end, sink, experiment.task), end.broken ? 1 : 0};
  recorder.add_times(result.summary);
  finish_run(recorder, tracker.model(), experiment.task, end, result.summary,
             "Servo run: " + a.task.stem().string(), servo_sections);
  if (interrupted()) result.exit_code = kInterrupted;
  return result;
}

int run(const ServoArguments& arguments) {
  const RunResult result = servo(arguments);
  print_result(result);
  return result.exit_code;
}

}  // namespace kestrel::app

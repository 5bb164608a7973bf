#include "kestrel/lab/camera_experiment.hpp"

#include "kestrel/lab/camera_trace.hpp"
#include "kestrel/lab/run_metrics.hpp"

namespace kestrel {

std::string CameraExperiment::id() const {
  return scenario + "/" + law + (modifier.empty() ? "" : "/" + modifier);
}

LabRun run(const CameraExperiment& experiment, const LabClock& clock) {
  const CameraSetup& setup = experiment.setup;
  LabRun made;
  made.id = experiment.id();
  made.scenario = experiment.scenario;
  made.law = experiment.law;
  made.modifier = experiment.modifier;
  made.kind = RunKind::Camera;
  setup.check();
  const Eigen::Vector3d centre_m = centre_of(setup.scenario.points_m);
  const int every = experiment.trace_every;
  if (every > 0) made.trace.columns = camera_trace_columns(setup.scenario.points_m.size());
  RunMeter meter(setup);
  RunStep last;
  const RunResult result = run_camera(
      setup,
      [&](const RunStep& step) {
        meter.add(step);
        if (every == 0) return;
        last = step;
        if (step.step % every == 0) {
          made.trace.rows.push_back(camera_trace_row(step, setup.camera, centre_m));
        }
      },
      clock);
  if (every > 0 && result.steps > 0 && last.step % every != 0) {
    made.trace.rows.push_back(camera_trace_row(last, setup.camera, centre_m));
  }
  made.end = result.end;
  made.refusal = result.refusal;
  made.steps = result.steps;
  made.metrics = named(meter.metrics(), setup.conditions.rate_hz);
  made.law_us = result.steps > 0 ? 1e6 * result.law_s / result.steps : 0;
  return made;
}

}  // namespace kestrel

#include "kestrel/lab/camera_experiment.hpp"

#include "kestrel/lab/camera_trace.hpp"
#include "kestrel/lab/run_metrics.hpp"

#include "run_record.hpp"

namespace kestrel {

std::string CameraExperiment::id() const {
  return scenario + "/" + law + (modifier.empty() ? "" : "/" + modifier);
}

LabRun run(const CameraExperiment& experiment, const LabClock& clock) {
  const CameraSetup& setup = experiment.setup;
  setup.check();
  const Eigen::Vector3d centre_m = centre_of(setup.scenario.points_m);
  TraceRecorder<RunStep> trace(experiment.trace_every, [&](const RunStep& step) {
    return camera_trace_row(step, setup.camera, centre_m);
  });
  RunMeter meter(setup);
  const auto observe = [&](const RunStep& step) {
    meter.add(step);
    trace.add(step);
  };
  LabRun made = labelled(experiment, RunKind::Camera, run_camera(setup, observe, clock));
  made.metrics = named(meter.metrics(), setup.conditions.rate_hz);
  if (experiment.trace_every > 0) {
    made.trace = {camera_trace_columns(setup.scenario.points_m.size()), trace.rows()};
  }
  return made;
}

}  // namespace kestrel

#include "kestrel/lab/helicopter_experiment.hpp"

#include "kestrel/lab/helicopter_metrics.hpp"
#include "kestrel/lab/helicopter_trace.hpp"

#include "run_record.hpp"

namespace kestrel {

std::string HelicopterExperiment::id() const {
  return scenario + "/" + law + (modifier.empty() ? "" : "/" + modifier);
}

std::string helicopter_law_label(HelicopterVariant variant, Law law) {
  const std::string label = name(variant);
  return variant == HelicopterVariant::Mejias ? label : label + "_" + name(law);
}

LabRun run(const HelicopterExperiment& experiment, const LabClock& clock) {
  const HelicopterSetup& setup = experiment.setup;
  TraceRecorder<HelicopterStep> trace(experiment.trace_every, [&](const HelicopterStep& step) {
    return helicopter_trace_row(step, setup.camera);
  });
  HelicopterMeter meter(setup);
  const auto observe = [&](const HelicopterStep& step) {
    meter.add(step);
    trace.add(step);
  };
  LabRun made = labelled(experiment, RunKind::Helicopter, run_helicopter(setup, observe, clock));
  made.metrics = named(meter.metrics());
  if (experiment.trace_every > 0) {
    made.trace = {helicopter_trace_columns(setup.scenario.points_m.size()), trace.rows()};
  }
  return made;
}

}  // namespace kestrel

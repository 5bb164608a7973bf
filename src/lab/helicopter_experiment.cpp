#include "kestrel/lab/helicopter_experiment.hpp"

#include "kestrel/lab/helicopter_metrics.hpp"
#include "kestrel/lab/helicopter_trace.hpp"

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
  LabRun made;
  made.id = experiment.id();
  made.scenario = experiment.scenario;
  made.law = experiment.law;
  made.modifier = experiment.modifier;
  made.kind = RunKind::Helicopter;
  const int every = experiment.trace_every;
  if (every > 0) made.trace.columns = helicopter_trace_columns(setup.scenario.points_m.size());
  HelicopterMeter meter(setup);
  HelicopterStep last;
  const RunResult result = run_helicopter(
      setup,
      [&](const HelicopterStep& step) {
        meter.add(step);
        if (every == 0) return;
        last = step;
        if (step.frame.step % every == 0) {
          made.trace.rows.push_back(helicopter_trace_row(step, setup.camera));
        }
      },
      clock);
  if (every > 0 && result.steps > 0 && last.frame.step % every != 0) {
    made.trace.rows.push_back(helicopter_trace_row(last, setup.camera));
  }
  made.end = result.end;
  made.refusal = result.refusal;
  made.steps = result.steps;
  made.metrics = named(meter.metrics());
  made.law_us = result.steps > 0 ? 1e6 * result.law_s / result.steps : 0;
  return made;
}

}  // namespace kestrel

#pragma once

#include <string>

#include "kestrel/lab/helicopter_run.hpp"
#include "kestrel/lab/lab_run.hpp"

namespace kestrel {

/// A helicopter run to be made, with the labels that it is filed under.
struct HelicopterExperiment {
  std::string scenario;  // "H0"
  std::string law;       // "vp4_des": variant and law inside, or a name of the user's
  std::string modifier;  // "" or e.g. "kz2"
  HelicopterSetup setup;
  int trace_every = 1;  // frames from one row of the trace to the next; 0: no trace

  /// "H0/vp4_des" or "H0/vp4_des/kz2".
  std::string id() const;
};

/// "vp4_des", "vp3_hh_mean", "mejias": the label of a law on a helicopter.
std::string helicopter_law_label(HelicopterVariant variant, Law law);

/// Makes the run: its end, figures (helicopter_metrics.hpp) and trace (helicopter_trace.hpp). The
/// trace holds frame 0, every trace_every-th and the last. law_us is by `clock`, 0 without one; all
/// else depends on the experiment alone.
LabRun run(const HelicopterExperiment& experiment, const LabClock& clock = {});

}  // namespace kestrel

#pragma once

#include <string>

#include "kestrel/lab/camera_run.hpp"
#include "kestrel/lab/lab_run.hpp"

namespace kestrel {

/// A run to be made, with the labels that it is filed under.
struct CameraExperiment {
  std::string scenario;  // "S3_rz90"
  std::string law;       // name of the law, or of a variant of its options
  std::string modifier;  // "" or e.g. "kz2"
  CameraSetup setup;
  int trace_every = 1;  // steps from one row of the trace to the next; 0: no trace

  /// "S3_rz90/cur" or "S3_rz90/cur/kz2".
  std::string id() const;
};

/// Makes the run: its end, figures and trace. The trace holds step 0, every trace_every-th and the
/// last. law_us is by `clock`, 0 without one; all else depends on the experiment alone.
LabRun run(const CameraExperiment& experiment, const LabClock& clock = {});

}  // namespace kestrel

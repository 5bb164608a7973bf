#pragma once

#include <vector>

#include "kestrel/lab/helicopter_experiment.hpp"

namespace kestrel {

/// A law as the helicopter benchmark runs it: gain 0.5/s, the pseudo-inverse answers however ill
/// conditioned its matrix is.
HelicopterLawOptions benchmark_helicopter_law(HelicopterVariant variant, Law law);

/// One run of the benchmark: scenario, variant, law inside and modifier (see modified()).
HelicopterExperiment helicopter_experiment(const HelicopterScenario& scenario,
                                           HelicopterVariant variant, Law law,
                                           const std::string& modifier = "");

/// The helicopter benchmark (doc/compare.md): from H0 and H1, vp4, raw4, drop6, vp3_hh and vp3 with
/// cur, des and mean, and mejias; each as it is, with gain 2, depth factors 2 and 4, a pixel of
/// noise, a pitch bias of 2 deg, 0.2 s of latency, and the paper's 0.93 s per frame and as much
/// latency, both without and with prediction. In the order of the tables.
std::vector<HelicopterExperiment> helicopter_benchmark();

}  // namespace kestrel

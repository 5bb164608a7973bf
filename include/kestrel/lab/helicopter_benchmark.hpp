#pragma once

#include <vector>

#include "kestrel/lab/helicopter_run.hpp"

namespace kestrel {

/// The helicopter benchmark (servo.md section 4): every variant with its laws, from H0 and H1, at
/// 30 Hz and at the paper's 0.93 s per frame, with the modifiers that tell them apart. Ids are
/// "H0/vp4_mean" or "H1/vp3_hh_des/kz2". In the order of the tables.
std::vector<HelicopterExperiment> helicopter_benchmark();

}  // namespace kestrel

#pragma once

#include "kestrel/servo/control_law.hpp"

namespace kestrel::laws {

/// Why this input is nothing for this law; None: the law may look at it. Condition and what only
/// the law knows come later.
LawRefusal refusal_of(const LawInput& input, Law law);

/// What to call a singular Jacobian: Collinear when the points are (nearly) on a line.
LawRefusal cause_of_singularity(const LawInput& input);

}  // namespace kestrel::laws

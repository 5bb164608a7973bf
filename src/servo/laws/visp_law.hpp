#pragma once

#include <vector>

#include "kestrel/servo/control_law.hpp"

namespace kestrel::laws {

/// The matrix vpServo is to invert.
enum class VispMatrix { Current, Desired, Mean };

/// cur, des and mean as vpServo computes them: EYEINHAND_L_cVe_eJe with the basis as eJe. `seen`
/// are the measured points with the depths the law wants to have. From any thread: vpServo counts
/// its calls in a static variable, so one call waits for the other.
LawAnswer visp_law(VispMatrix matrix, const std::vector<Feature>& seen, const LawInput& input,
                   const LawOptions& options);

}  // namespace kestrel::laws

#pragma once

#include <vector>

#include <Eigen/Core>

#include "kestrel/servo/feature.hpp"

namespace kestrel {

/// Interaction matrix L of points, 2n x 6: ds/dt = L v_c with s = (x0 y0 x1 y1 ...) normalised and
/// v_c the camera twist. Chaumette & Hutchinson 2006, eq. (11); computed by ViSP. Throws
/// std::invalid_argument for a depth below 1e-6 m or a number that is not finite.
Eigen::MatrixXd interaction_matrix(const std::vector<Feature>& features);

}  // namespace kestrel

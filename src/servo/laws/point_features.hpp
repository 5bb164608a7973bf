#pragma once

#include <vector>

#include <Eigen/Core>

#include "kestrel/servo/control_law.hpp"

#include "pseudo_inverse.hpp"

namespace kestrel::laws {

/// e = s - s*, (x0 y0 x1 y1 ...).
Eigen::VectorXd point_error(const LawInput& input);

/// s, (x0 y0 x1 y1 ...).
Eigen::VectorXd stacked(const std::vector<Feature>& points);

/// Interaction matrix of points in front of the camera, 2n x 6 (Chaumette & Hutchinson 2006,
/// eq. 11); as interaction_matrix(), without ViSP.
TaskJacobian point_matrix(const std::vector<Feature>& points);

/// Area of the closed polygon of the points in their order, normalised plane, not negative.
double polygon_area(const std::vector<Feature>& points);

/// Mean of the depths, m.
double mean_depth(const std::vector<Feature>& points);

/// Whether all points are within this share of their extent on one line.
bool on_a_line(const std::vector<Feature>& points, double share);

}  // namespace kestrel::laws

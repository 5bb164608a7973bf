#pragma once

#include <functional>

#include <Eigen/Core>

#include "servo/law_bench.hpp"
#include "support/random.hpp"

/// What the laws' errors do when the camera moves, by differences: an oracle that knows no formula.
namespace kestrel::test {

/// A pose after the camera has made a twist for a time.
TargetPose after(const TargetPose& pose, const Vector6d& twist, double duration_s);

/// Interaction matrix of a law's error by central differences of the error it reports. Rounding
/// 1e-16 / h and third derivatives h^2 leave 1e-9 of the matrix's size or so.
Eigen::MatrixXd error_rate(const TargetPose& pose, Law law,
                           const std::function<LawInput(const TargetPose&)>& at);

Eigen::MatrixXd error_rate(const TargetPose& pose, Law law);

/// A camera somewhere in front of the bench's target, turned by this much at most.
TargetPose any_view(Random& random, double max_turn_rad, double max_tilt_rad);

/// Distance of camera and target's centre, the largest on a flight, over that at its start, m.
double retreat_on_flight(const TargetPose& start, Law law, int steps, double dt_s);

}  // namespace kestrel::test

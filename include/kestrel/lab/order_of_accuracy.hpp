#pragma once

#include <optional>

#include "kestrel/geometry/twist.hpp"
#include "kestrel/lab/camera_run.hpp"

namespace kestrel {

/// The twist that would be best from a camera displaced by c*Mc.
enum class IdealTwist {
  Screw,         // log of c*Mc: the geodesic of SE(3)
  StraightLine,  // (R^T t, theta u): straight in space, shortest rotation
};

/// How the order of accuracy is measured.
struct AccuracyOptions {
  /// xi: the camera is displaced by exp(xi eps), m and rad.
  Vector6d displacement = (Vector6d() << .20, -.15, .25, .35, -.25, .60).finished();
  double coarse = 0.0125;  // eps
  double fine = 0.00625;   // eps
  IdealTwist ideal = IdealTwist::Screw;
};

/// How far the law's first twist is from the ideal one when the camera stands at exp(xi eps) of the
/// setup's goal, for a gain of 1/s: |v + ideal|, m/s and rad/s together. Empty when the law gives
/// no twist there.
std::optional<double> first_twist_error(const CameraSetup& setup, const Vector6d& displacement,
                                        IdealTwist ideal);

/// Slope of log |v + ideal| over log eps: 2 for an approximation of the interaction matrix that is
/// right to first order (cur, des), 3 for those right to second (mean, mjp). Empty when the law
/// gives no twist at one of the two. The setup's start and gain are not looked at.
std::optional<double> order_of_accuracy(const CameraSetup& setup, const AccuracyOptions& options);

}  // namespace kestrel

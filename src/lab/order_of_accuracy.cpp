#include "kestrel/lab/order_of_accuracy.hpp"

#include <cmath>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/lab/law_sight.hpp"

namespace kestrel {
namespace {

/// The twist of 1 s that takes the camera from exp(xi) of its goal to the goal, sign changed.
Vector6d ideal_twist(const Vector6d& xi, IdealTwist ideal) {
  if (ideal == IdealTwist::Screw) return xi;
  const Displacement pose = exponential(xi, 1);
  return (Vector6d() << pose.rotation.transpose() * pose.translation, xi.tail<3>()).finished();
}

}  // namespace

std::optional<double> first_twist_error(const CameraSetup& setup, const Vector6d& displacement,
                                        IdealTwist ideal) {
  const Displacement start = exponential(displacement, 1);
  CameraSetup at_start = setup;
  at_start.scenario = scenario_from(setup.scenario.name, setup.scenario.points_m,
                                    setup.scenario.goal, {start.rotation, start.translation});
  at_start.law.gain = LawGain::constant(1);
  LawSight sight(at_start);
  const TargetPose& pose = at_start.scenario.start;
  sight.look(seen_points(pose, at_start.scenario.points_m), pose, Vector6d::Zero());
  const LawAnswer answer = control_law(sight.told(), at_start.law);
  if (!answer.twist) return std::nullopt;
  return (answer.twist->vector() + ideal_twist(displacement, ideal)).norm();
}

std::optional<double> order_of_accuracy(const CameraSetup& setup, const AccuracyOptions& options) {
  const auto error = [&](double eps) {
    return first_twist_error(setup, options.displacement * eps, options.ideal);
  };
  const std::optional<double> coarse = error(options.coarse);
  const std::optional<double> fine = error(options.fine);
  if (!coarse || !fine) return std::nullopt;
  return std::log(*coarse / *fine) / std::log(options.coarse / options.fine);
}

}  // namespace kestrel

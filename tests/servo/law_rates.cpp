#include "servo/law_rates.hpp"

#include <algorithm>

namespace kestrel::test {

TargetPose after(const TargetPose& pose, const Vector6d& twist, double duration_s) {
  return moved(pose.inverse(), CameraTwist::from_vector(twist), duration_s).inverse();
}

Eigen::MatrixXd error_rate(const TargetPose& pose, Law law,
                           const std::function<LawInput(const TargetPose&)>& at) {
  const double h = 1e-5;
  const auto error = [&](const Vector6d& twist) {
    return control_law(at(after(pose, twist, 1)), unit_options(law)).error;
  };
  Eigen::MatrixXd L(error(Vector6d::Zero()).size(), 6);
  for (int k = 0; k < 6; ++k) {
    L.col(k) = (error(h * Vector6d::Unit(k)) - error(-h * Vector6d::Unit(k))) / (2 * h);
  }
  return L;
}

Eigen::MatrixXd error_rate(const TargetPose& pose, Law law) {
  return error_rate(pose, law, input_at);
}

TargetPose any_view(Random& random, double max_turn_rad, double max_tilt_rad) {
  const Eigen::Vector3d at(random.uniform(-.2, .2), random.uniform(-.2, .2),
                           random.uniform(.5, 1.5));
  return {rotation_from_vector(random.rotation_vector(max_tilt_rad)) *
              rotation_from_vector({0, 0, random.uniform(-max_turn_rad, max_turn_rad)}),
          at};
}

double retreat_on_flight(const TargetPose& start, Law law, int steps, double dt_s) {
  double largest = 0;
  fly(start, unit_options(law), steps, dt_s,
      [&](const Moment& m) { largest = std::max(largest, m.pose.translation.norm()); });
  return largest - std::max(start.translation.norm(), kBenchGoal.translation.norm());
}

}  // namespace kestrel::test

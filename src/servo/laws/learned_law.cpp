#include <cmath>
#include <utility>

#include "laws.hpp"
#include "point_features.hpp"
#include "pseudo_inverse.hpp"

namespace kestrel::laws {
namespace {

/// Motions of the camera (m, rad) below this say nothing: the rounding of s, 1e-16, over them would
/// be learned as if it were the Jacobian.
constexpr double kSmallestMotion = 1e-12;
/// Where the covariance of directions in which the camera does not move stops to grow: far from
/// overflow, far above what any run brings.
constexpr double kLargestCovariance = 1e100;

bool is_known(const LawState& state, const Eigen::VectorXd& s, Law law) {
  const bool has_covariance =
      state.covariance.rows() == 6 && state.covariance.cols() == 6 && state.covariance.allFinite();
  if (law == Law::Rls && !has_covariance) return false;
  return state.jacobian.rows() == s.size() && state.jacobian.cols() == 6 &&
         state.features.size() == s.size() && state.jacobian.allFinite() &&
         state.features.allFinite() && state.motion.allFinite();
}

/// Before anything is learned: J = L*.
LawState untaught(const LawInput& input, const Eigen::VectorXd& s, const LawOptions& options) {
  LawState state;
  state.jacobian = point_matrix(input.desired);
  if (options.law == Law::Rls) {
    state.covariance = options.initial_covariance * Matrix6d::Identity();
  }
  state.features = s;
  return state;
}

/// The secant that fits what was seen and changes J least (Broyden 1965).
void learn_secant(LawState& state, const Eigen::VectorXd& ds) {
  const Vector6d& dx = state.motion;
  state.jacobian += (ds - state.jacobian * dx) * dx.transpose() / dx.squaredNorm();
}

/// Recursive least squares of ds = J dx with exponential forgetting, all rows with one covariance
/// (Piepmeier, McMurray & Lipkin 2004).
void learn_recursively(LawState& state, const Eigen::VectorXd& ds, double forgetting) {
  const Vector6d& dx = state.motion;
  const Vector6d P_dx = state.covariance * dx;
  const Vector6d weight = P_dx / (forgetting + dx.dot(P_dx));
  state.jacobian += (ds - state.jacobian * dx) * weight.transpose();
  Matrix6d P = state.covariance - weight * P_dx.transpose();
  if (P.trace() < kLargestCovariance) P /= forgetting;
  state.covariance = (P + P.transpose()) / 2;  // rounding must not make it lopsided
}

LawState learned(LawState state, const LawInput& input, const Eigen::VectorXd& s,
                 const LawOptions& options) {
  if (!input.camera_motion) {  // nobody knows what moved the points since then
    state.features = s;
    state.motion.setZero();
    return state;
  }
  state.motion += *input.camera_motion;
  const Eigen::VectorXd ds = s - state.features;
  const bool gated = options.law == Law::Broyden && !(ds.norm() > options.learning_gate);
  if (gated || !(state.motion.norm() > kSmallestMotion)) return state;
  if (options.law == Law::Rls) {
    learn_recursively(state, ds, options.forgetting);
  } else {
    learn_secant(state, ds);
  }
  state.features = s;
  state.motion.setZero();
  return state;
}

}  // namespace

LawAnswer learned_law(const LawInput& input, const LawOptions& options, const LawState& state) {
  const Eigen::VectorXd s = stacked(input.measured);
  LawState next = is_known(state, s, options.law) ? learned(state, input, s, options)
                                                  : untaught(input, s, options);
  LawAnswer answer = solved(next.jacobian, point_error(input), input, options);
  answer.next = std::move(next);
  return answer;
}

}  // namespace kestrel::laws

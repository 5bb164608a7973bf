#include "kestrel/servo/servo.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

/// The most by which R^T R may miss the identity: what six written digits leave.
constexpr double kRotationTolerance = 1e-6;
constexpr double kLargestLeverArm_m = 1e6;

bool is_rigid(const Mount& mount) {
  return rotation_defect(mount.rotation) <= kRotationTolerance &&
         (mount.translation.array().abs() <= kLargestLeverArm_m).all();
}

LawAnswer refused(LawRefusal refusal, const LawState& state) {
  LawAnswer answer;
  answer.refusal = refusal;
  answer.next = state;
  return answer;
}

/// The gain under the names of ServoOptions.
void check_gain(const ServoOptions& o) {
  std::ostringstream message;
  if (!(std::isfinite(o.gain_per_s) && o.gain_per_s > 0)) {
    message << "gain_per_s: must be positive and finite (1/s), is " << o.gain_per_s;
  } else if (o.far_gain_per_s && !(*o.far_gain_per_s > 0 && *o.far_gain_per_s <= o.gain_per_s)) {
    message << "far_gain_per_s: must be positive and not above gain_per_s (1/s), is "
            << *o.far_gain_per_s;
  } else if (!(std::isfinite(o.gain_slope_per_s) && o.gain_slope_per_s >= 0)) {
    message << "gain_slope_per_s: must be finite and not negative (1/s), is " << o.gain_slope_per_s;
  } else {
    return;
  }
  throw std::invalid_argument(message.str());
}

}  // namespace

void ServoOptions::check() const {
  check_gain(*this);
  law_options(*this).check();
}

LawOptions law_options(const ServoOptions& options) {
  LawOptions law;
  law.law = options.law;
  law.solver = LawSolver::Visp;
  law.gain = LawGain::constant(options.gain_per_s);
  if (options.far_gain_per_s) {
    law.gain = {options.gain_per_s, *options.far_gain_per_s, options.gain_slope_per_s};
  }
  law.smooth_start_per_s = options.smooth_start_per_s;
  law.max_condition = kLargestCondition;
  law.damping = options.damping;
  law.learning_gate = options.learning_gate;
  law.forgetting = options.forgetting;
  law.initial_covariance = options.initial_covariance;
  return law;
}

TwistBasis body_basis(const Mount& body_from_camera, Freedom freedom) {
  const Transform<frame::Camera, frame::Body> camera_from_body = body_from_camera.inverse();
  const Matrix6d cVb = twist_matrix(camera_from_body.rotation, camera_from_body.translation);
  if (freedom == Freedom::Six) return cVb;
  TwistBasis basis(6, freedom == Freedom::Four ? 4 : 3);
  basis.leftCols<3>() = cVb.leftCols<3>();
  if (freedom == Freedom::Four) basis.col(3) = cVb.col(5);
  return basis;
}

LawAnswer law_on_body(LawInput input, const Mount& body_from_camera, const ServoOptions& options,
                      const LawState& state) {
  if (!is_rigid(body_from_camera)) return refused(LawRefusal::Unreachable, state);
  if (!std::isfinite(options.gain_per_s)) return refused(LawRefusal::NotFinite, state);
  input.basis = body_basis(body_from_camera, options.freedom);
  return control_law(input, law_options(options), state);
}

std::optional<Servo> servo(const std::vector<Feature>& measured,
                           const std::vector<Feature>& desired, const Mount& body_from_camera,
                           const ServoOptions& options) {
  LawInput input;
  input.measured = measured;
  input.desired = desired;
  const LawAnswer answer = law_on_body(std::move(input), body_from_camera, options);
  if (!answer.twist) return std::nullopt;
  return Servo{*answer.twist, answer.error, answer.condition};
}

const char* name(Freedom freedom) {
  switch (freedom) {
    case Freedom::Six:
      return "six";
    case Freedom::Four:
      return "four";
    case Freedom::Three:
      return "three";
  }
  return "unknown";
}

}  // namespace kestrel

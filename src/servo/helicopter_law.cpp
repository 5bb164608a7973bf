#include "kestrel/servo/helicopter_law.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "kestrel/geometry/rotation.hpp"

#include "laws/heading_hold.hpp"

namespace kestrel {
namespace {

using Points = std::vector<Feature>;

/// The most by which R^T R may miss the identity.
constexpr double kRotationTolerance = 1e-6;
constexpr double kSmallestDepth_m = 1e-6;  // as control_law

bool is_levelled(HelicopterVariant variant) {
  return variant != HelicopterVariant::Raw4 && variant != HelicopterVariant::Drop6;
}

HelicopterLawAnswer refused(LawRefusal reason, const LawState& state) {
  HelicopterLawAnswer answer;
  answer.refusal = reason;
  answer.law.refusal = reason;
  answer.law.next = state;
  return answer;
}

/// The poses of a camera that moved: c*Mc and cMo for now instead of then. A homography is of the
/// old image and is dropped.
void move_poses(LawInput& input, const CameraMotion& now_from_then) {
  if (input.goal_from_camera) {
    const CameraMotion goal_from_then{input.goal_from_camera->rotation,
                                      input.goal_from_camera->translation};
    const CameraMotion goal_from_now = goal_from_then * now_from_then.inverse();
    input.goal_from_camera = Displacement{goal_from_now.rotation, goal_from_now.translation};
  }
  if (input.camera_from_target) {
    input.camera_from_target = now_from_then * *input.camera_from_target;
  }
}

/// The input as the camera would give it from the levelled helicopter.
LawInput levelled(const HelicopterLawInput& input) {
  const Eigen::Matrix3d R =
      level_camera_from_camera(input.body_from_camera.rotation, input.attitude);
  LawInput level = input.camera;
  level.measured = turned(level.measured, R);
  move_poses(level, CameraMotion{R, Eigen::Vector3d::Zero()});
  if (level.camera_from_goal_homography) {
    level.camera_from_goal_homography = R * *level.camera_from_goal_homography;
  }
  return level;
}

/// The camera on the levelled helicopter: its axes are those in the body, its place is that of the
/// camera on the tilted one.
Mount levelled(const Mount& body_from_camera, const Attitude& attitude) {
  return {body_from_camera.rotation, level_from_body(attitude) * body_from_camera.translation};
}

LawInput over_latency(LawInput input, const CameraMotion& now_from_then) {
  input.measured = predicted(with_area_depth(input.measured, input.desired), now_from_then);
  move_poses(input, now_from_then);
  input.camera_from_goal_homography.reset();
  return input;
}

int columns_of(HelicopterVariant variant) {
  switch (variant) {
    case HelicopterVariant::Vp4:
    case HelicopterVariant::Raw4:
      return 4;
    case HelicopterVariant::Drop6:
      return 6;
    default:
      return 3;
  }
}

bool are_in_front(const Points& points) {
  return !points.empty() && is_finite(points) &&
         std::all_of(points.begin(), points.end(),
                     [](const Feature& f) { return f.depth_m >= kSmallestDepth_m; });
}

/// What the camera's twist asks of the helicopter, with the heading hold of vp3_hh.
HelicopterLawAnswer on_helicopter(LawAnswer law, const LawInput& seen, const Mount& mount,
                                  const HelicopterLawInput& input,
                                  const HelicopterLawOptions& options) {
  HelicopterLawAnswer answer;
  answer.refusal = law.refusal;
  if (law.twist) {
    BodyTwist twist = mount * *law.twist;
    twist.angular.head<2>().setZero();
    if (columns_of(options.variant) == 3) twist.angular.setZero();
    if (options.variant == HelicopterVariant::Vp3Hh) {
      const double r =
          -options.heading_gain_per_s * wrap_angle(input.heading_rad - input.goal_heading_rad);
      twist.linear += laws::against_turn(options.law.law, seen, mount, r);
      twist.angular.z() = r;
    }
    answer.twist = twist;
  }
  answer.law = std::move(law);
  return answer;
}

LawRefusal refusal_of(const HelicopterLawInput& input) {
  const Attitude& a = input.attitude;
  const bool finite = std::isfinite(a.roll) && std::isfinite(a.pitch) && std::isfinite(a.yaw) &&
                      std::isfinite(input.heading_rad) && std::isfinite(input.goal_heading_rad) &&
                      input.body_from_camera.translation.allFinite();
  if (!finite) return LawRefusal::NotFinite;
  // Said here: levelled, a point behind the camera could be anywhere.
  const Points& measured = input.camera.measured;
  const auto is_behind = [](const Feature& f) { return f.depth_m < kSmallestDepth_m; };
  if (std::any_of(measured.begin(), measured.end(), is_behind)) return LawRefusal::Depth;
  const bool rotates = rotation_defect(input.body_from_camera.rotation) <= kRotationTolerance;
  return rotates ? LawRefusal::None : LawRefusal::Unreachable;
}

}  // namespace

void HelicopterLawOptions::check() const {
  law.check();
  if (!std::isfinite(heading_gain_per_s) || heading_gain_per_s < 0) {
    throw std::invalid_argument("heading_gain_per_s: must be finite and not negative (1/s)");
  }
}

HelicopterLawAnswer helicopter_law(const HelicopterLawInput& input,
                                   const HelicopterLawOptions& options, const LawState& state) {
  const LawRefusal refusal = refusal_of(input);
  if (refusal != LawRefusal::None) return refused(refusal, state);
  const bool level = is_levelled(options.variant);
  const Mount mount =
      level ? levelled(input.body_from_camera, input.attitude) : input.body_from_camera;
  LawInput seen = level ? levelled(input) : input.camera;
  if (input.now_from_then) {
    seen = over_latency(std::move(seen), *input.now_from_then);
    if (!are_in_front(seen.measured)) return refused(LawRefusal::Singular, state);
  }
  const int columns = columns_of(options.variant);
  seen.basis = columns == 6 ? TwistBasis{} : laws::body_basis(mount, columns);
  LawOptions inside = options.law;
  if (options.variant == HelicopterVariant::Mejias) inside.law = Law::Decoupled;
  return on_helicopter(control_law(seen, inside, state), seen, mount, input, options);
}

}  // namespace kestrel

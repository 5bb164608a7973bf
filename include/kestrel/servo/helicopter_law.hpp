#pragma once

#include <optional>

#include "kestrel/geometry/attitude.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/geometry/twist.hpp"
#include "kestrel/servo/control_law.hpp"
#include "kestrel/servo/helicopter_variant.hpp"
#include "kestrel/servo/latency.hpp"

namespace kestrel {

/// Parameters of a law on a helicopter.
struct HelicopterLawOptions {
  HelicopterVariant variant = HelicopterVariant::Vp3Hh;
  LawOptions law{};                 // the law inside; of "mejias" its law is not looked at
  double heading_gain_per_s = 0.5;  // lambda_psi of "vp3_hh", >= 0

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// What a law on a helicopter may look at in one frame.
struct HelicopterLawInput {
  /// As of the camera that took the image, tilted as it was; desired features and poses of the
  /// goal: of the levelled camera. Its basis is not looked at. camera_motion, for the laws that
  /// learn: of the camera that the variant looks through (levelled, but for raw4 and drop6).
  LawInput camera;
  Mount body_from_camera;
  Attitude attitude;            // of the helicopter when the image was taken, as far as it is known
  double heading_rad = 0;       // psi, now: the compass is not as old as the image; of "vp3_hh"
  double goal_heading_rad = 0;  // psi*
  /// How the camera that the variant looks through has moved since the image was taken: given, the
  /// features are predicted over it (see latency.hpp), with their depth from the area.
  std::optional<CameraMotion> now_from_then;
};

/// What a law on a helicopter answers.
struct HelicopterLawAnswer {
  /// In the heading frame (the levelled body with its yaw); rates of roll and pitch are zero.
  /// Empty: hover.
  std::optional<BodyTwist> twist;
  LawRefusal refusal = LawRefusal::None;
  LawAnswer law;  // of the law inside: error, condition, singular values, what it has learned
};

/// The velocities the helicopter is to be asked for (Chaumette & Hutchinson 2006 for the law; the
/// levelled "virtual" camera as in Hamel & Mahony 2002). With L^ the matrix of the law inside, cVb
/// the twist matrix of the mount (levelled with the camera) and S4, S3 the columns (vx, vy, vz, r)
/// and (vx, vy, vz) of the body's twist:
///   vp4, raw4: -(L^ cVb S4)^+ lambda e;  drop6: rows 0, 1, 2 and 5 of bVc (-L^^+ lambda e);
///   vp3, mejias: -(L^ cVb S3)^+ lambda e;
///   vp3_hh: r = -lambda_psi wrap(psi - psi*), -(A3)^+ (lambda e + a_r r), [A3 a_r] = L^ cVb S4.
/// Laws that tell translation from rotation by themselves (2.5d, pbvs_ct, pbvs_co, screw) need no
/// a_r r: they do not take the turn for a translation. Where the law inside has no L^ of its own
/// for points, A is that of L(s, Z). A refusal of the law is passed on; NotFinite also for an
/// attitude or heading that is not, Unreachable for a mount that is no rotation, Singular when the
/// prediction puts a point behind the camera. Pure, and never throws for what a frame may bring.
HelicopterLawAnswer helicopter_law(const HelicopterLawInput& input,
                                   const HelicopterLawOptions& options, const LawState& state = {});

}  // namespace kestrel

#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "kestrel/geometry/attitude.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/geometry/twist.hpp"
#include "kestrel/servo/control_law.hpp"

namespace kestrel {

/// How a law for a free camera is put on a helicopter, which can be asked for four velocities only:
/// forward, right, down (of the levelled body with its heading) and the yaw rate.
enum class HelicopterVariant {
  Vp4,     // "vp4": features levelled by the attitude, all four velocities from the image
  Raw4,    // "raw4": the same on the features as they are; tilt is answered as if it were an error
  Drop6,   // "drop6": all six velocities from the image, roll and pitch rates thrown away
  Vp3Hh,   // "vp3_hh": levelled, three translations from the image, heading held by the compass
  Vp3,     // "vp3": levelled, three translations, no yaw
  Mejias,  // "mejias": levelled, centre of gravity and size (the law "decoupled"), no yaw
};

/// All variants in the order of the enumeration.
const std::vector<HelicopterVariant>& all_helicopter_variants();

/// The name a user writes, in quotes above.
const char* name(HelicopterVariant variant);

/// The variant of that name; empty when there is none.
std::optional<HelicopterVariant> helicopter_variant_named(std::string_view name);

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
  double goal_heading_rad = 0;  // psi*, of "vp3_hh"
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
/// a_r r: the turn is not mistaken for a translation. The point laws take a_r from their own L^,
/// the others from L(s, Z). Pure, and never throws for what a frame may bring.
HelicopterLawAnswer helicopter_law(const HelicopterLawInput& input,
                                   const HelicopterLawOptions& options, const LawState& state = {});

}  // namespace kestrel

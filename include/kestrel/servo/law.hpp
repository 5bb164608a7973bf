#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace kestrel {

/// The control laws a run can be servoed with; their names are those of the command line, the task
/// files and the result files. L = L(s, Z), L* = L(s*, Z*), e = s - s*, v the camera twist.
enum class Law {
  Cur,           // "cur": -gain L^+ e
  CurZdes,       // "cur_zdes": -gain L(s, Z*)^+ e
  CurZarea,      // "cur_zarea": one depth from the area, -gain L(s, Z* sqrt(a*/a))^+ e
  CurZhomog,     // "cur_zhomog": depths from the homography
  Des,           // "des": -gain L*^+ e
  Mean,          // "mean": -gain ((L + L*) / 2)^+ e
  MeanZdes,      // "mean_zdes": -gain ((L(s, Z*) + L*) / 2)^+ e
  Mjp,           // "mjp": -gain (L^+ + L*^+) / 2 e
  PmjR,          // "pmj_r": mean with L* turned into the current camera
  PmjT,          // "pmj_t": mean with L* moved into the current camera
  Lm,            // "lm": Levenberg-Marquardt
  Transpose,     // "transpose": L^T e, scaled by the largest singular value of L, squared
  TransposeRaw,  // "transpose_raw": L^T e (ViSP's TRANSPOSE)
  Broyden,       // "broyden": Jacobian learned by secants, gated and aligned with the delay
  BroydenRaw,    // "broyden_raw": the same, every step, nothing gated
  Rls,           // "rls": Jacobian learned by recursive least squares
  Polar,         // "polar": features (rho, theta)
  Partition,     // "partition": optical axis apart, the rest by L_xy
  TwoAndHalfD,   // "2.5d": one point, its depth ratio and the rotation
  Homog,         // "homog": straight from the homography
  PbvsCt,        // "pbvs_ct": pose, camera on a straight line
  PbvsCo,        // "pbvs_co": pose, target's centre on a straight line
  Screw,         // "screw": pose, the screw motion to the goal
  Moments,       // "moments": (xn, yn, an, alpha) and the tilt by pose-free moments
  Decoupled,     // "decoupled": the vehicle's three references from centre of gravity and size
};

/// All laws in the order of the enumeration: that of every table.
const std::vector<Law>& all_laws();

/// The name a user writes.
const char* name(Law law);

/// The law of that name; empty when there is none.
std::optional<Law> law_named(std::string_view name);

}  // namespace kestrel

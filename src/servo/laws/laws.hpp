#pragma once

#include <utility>

#include "kestrel/servo/control_law.hpp"

/// The families of laws behind control_law(). It checks what all laws need (points in equal number,
/// at three places or more, finite, in front of the camera; poses, homography, basis finite), and
/// does what all laws share: smooth start, the state of laws that learn nothing, no NaN. A family
/// answers with the twist of its gain, in the span of the basis.
namespace kestrel::laws {

/// An answer that gives no twist.
inline LawAnswer refused(LawRefusal reason, LawState next = {}) {
  LawAnswer answer;
  answer.refusal = reason;
  answer.next = std::move(next);
  return answer;
}

LawAnswer point_law(const LawInput& input, const LawOptions& options);  // cur ... transpose_raw
LawAnswer learned_law(const LawInput& input, const LawOptions& options,
                      const LawState& state);  // broyden, rls
LawAnswer polar_law(const LawInput& input, const LawOptions& options);
LawAnswer partition_law(const LawInput& input, const LawOptions& options);
LawAnswer hybrid_law(const LawInput& input, const LawOptions& options);  // 2.5d
LawAnswer homography_law(const LawInput& input, const LawOptions& options);
LawAnswer pose_law(const LawInput& input, const LawOptions& options);  // pbvs_ct, pbvs_co, screw
LawAnswer moments_law(const LawInput& input, const LawOptions& options);
LawAnswer decoupled_law(const LawInput& input, const LawOptions& options);

}  // namespace kestrel::laws

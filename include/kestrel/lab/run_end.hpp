#pragma once

#include <optional>
#include <string_view>

namespace kestrel {

/// How a run ended; every run has one.
enum class RunEnd {
  Converged,     // "converged": the error is below the threshold at the end (helicopter: "ok")
  LocalMinimum,  // "local_minimum": stands still with an error left
  Collision,     // "collision": a point nearer than allowed, or behind the camera
  Diverged,      // "diverged": farther than allowed from the target, or not finite
  OutOfView,     // "out_of_view": a point left the image and the rules stop there
  TimedOut,      // "timed_out"
  Refused,       // "refused": the law gave no twist at the end; the refusal says why
  PositionOnly,  // "position_only": helicopter, position within tolerance, heading not
  HeadingOnly,   // "heading_only": helicopter, heading within tolerance, position not
};

/// The word in quotes above.
const char* name(RunEnd end);

/// The end of that name; empty when there is none.
std::optional<RunEnd> run_end_named(std::string_view name);

}  // namespace kestrel

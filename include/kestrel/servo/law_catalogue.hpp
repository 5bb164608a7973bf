#pragma once

#include <string>

#include "kestrel/servo/law.hpp"

namespace kestrel {

/// What a student should know about a law before flying it. Plain sentences, no markup; formulas in
/// ASCII: L = L(s, Z) at what is seen, L* = L(s*, Z*) at the goal, e = s - s*, ^+ the
/// pseudo-inverse, lambda the gain, v = (vx vy vz wx wy wz) the twist of the camera, a star what
/// belongs to the goal.
struct LawSheet {
  std::string title;    // one line
  std::string formula;  // of v
  std::string needs;    // besides the points seen and those wanted
  std::string source;   // papers
  std::string use;      // when to take it
  std::string breaks;   // what goes wrong with it
};

/// The sheet of a law; every law has one.
const LawSheet& law_sheet(Law law);

}  // namespace kestrel

#pragma once

#include "kestrel/servo/law.hpp"

namespace kestrel {

/// Whether the law looks at a pose of the target or of the camera.
inline bool needs_pose(Law law) {
  switch (law) {
    case Law::PmjR:
    case Law::PmjT:
    case Law::TwoAndHalfD:
    case Law::PbvsCt:
    case Law::PbvsCo:
    case Law::Screw:
      return true;
    default:
      return false;
  }
}

/// Whether it looks at the homography from the goal's image.
inline bool needs_homography(Law law) { return law == Law::CurZhomog || law == Law::Homog; }

}  // namespace kestrel

#pragma once

#include <Eigen/Core>

#include "kestrel/vision/image_pyramid.hpp"

#include "block_look.hpp"
#include "level_pairs.hpp"

namespace kestrel {

/// When a descent ends and which steps are believed; lengths in coordinates of warp().
struct DescentBounds {
  int steps = 0;
  double tolerance = 0;  // a step that moves no corner by more is the last
  double range = 0;      // of the linearisation: an eighth of the finest texture's period, 2 px
};

/// Where a descent began: where the alignment did, and where a coarser level has led it.
struct DescentStart {
  Homography first;
  Homography led;
};

struct Descended {
  Homography image_from_template;
  int looks = 0;  // at places to step from
};

/// Gauss-Newton steps at one level, damped as Levenberg and Marquardt do: a step beyond the range
/// of its linearisation to where the image shows less of the template is taken back and tried
/// shorter. Where they do not settle, of the places passed the one that shows most. They begin
/// where the coarser level has led, unless the first place shows more: what is fine texture to one
/// level is noise to the next. `scaled` is scaled_from_template().
Descended descend(BlockLook& look, const ImagePyramid& image, const LevelPair& at,
                  const DescentStart& start, const DescentBounds& bounds,
                  const Eigen::Matrix3d& scaled);

}  // namespace kestrel

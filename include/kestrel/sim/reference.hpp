#pragma once

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/pixel.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/sim/scene.hpp"

namespace kestrel {

/// The picture a template is learned from, and what its rectangle measures.
struct Reference {
  cv::Mat image;  // 8-bit grey
  /// Whole pixels that lie on the target entirely: as a Template takes them.
  PixelBox box;
  /// What the box spans from outer edge to outer edge (PlaneSize), m: up to two pixels less than
  /// the target does.
  double width_m = 0;
  double height_m = 0;
  /// The box's centre is that of the learned template, not quite that of the target: where the
  /// edges fall within their pixels decides. A goal for the target becomes one for the template by
  /// camera_from_target * target_from_template.
  Transform<frame::Target, frame::Target> target_from_template;
};

/// The target of the scene, without what hides it, photographed from straight in front of its
/// centre at the goal's distance, |translation| of goal, by the camera without its lens: pixels are
/// then squares on the target whatever the goal and the lens. Throws std::invalid_argument when the
/// scene has no plane, the goal's target is not in front of the camera, or the target does not fit
/// into the picture or spans less than 16 px.
Reference goal_view(const Scene& scene, const Camera& camera, const TargetPose& goal);

}  // namespace kestrel

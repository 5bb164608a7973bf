#pragma once

#include <array>
#include <optional>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/homography.hpp"
#include "kestrel/geometry/transform.hpp"

namespace kestrel {

/// A planar template's size: in the template image (px) and in the world (m). The template's
/// width_px pixels span width_m, from the outer edge of the first pixel to that of the last.
struct PlaneSize {
  double width_px = 0;
  double height_px = 0;
  double width_m = 0;
  double height_m = 0;
};

/// The corners of the template (pixel centres, see template_corners) in the Target frame, m.
std::array<Eigen::Vector3d, 4> corners_in_target(const PlaneSize& size);

/// Pose of a plane from one view, with its rival.
struct PlanePose {
  TargetPose camera_from_target;
  double reprojection_px = 0;  // RMS of the four corners
  /// The second minimum of the reprojection error, when the view has one: the plane tilted to
  /// the other side (the two-fold ambiguity of a nearly affine view).
  std::optional<TargetPose> rival;
  double rival_reprojection_px = 0;
  /// True when there is a rival that the corner noise does not let one exclude.
  bool ambiguous = false;
};

/// Options of plane_pose.
struct PlanePoseOptions {
  /// Standard deviation of each corner coordinate, px: what the evidence between the two
  /// solutions is measured in.
  double corner_noise_px = 0.5;

  /// Throws std::invalid_argument for a negative or non-finite noise.
  void check() const;
};

/// Pose of the template plane from its homography; the camera's lens is removed at the corners.
/// Both minima of the planar ambiguity are found (Schweighofer & Pinz 2006 show there are at most
/// two): closed-form starts (Collins & Bartoli 2014), each refined on the reprojection error of the
/// four corners. The one with the smaller error is chosen, as the likelier; unless its odds are
/// below 100 to 1 (the sums of squares differ by less than 9.2 corner_noise_px^2), when the one
/// that turns least from `previous` is. Empty when H is not finite, a corner cannot be seen through
/// the lens, the outline is not that of a plane seen from the front (convex, clockwise), or no
/// solution has the plane in front of the camera. Never throws.
std::optional<PlanePose> plane_pose(const Homography& image_from_template, const PlaneSize& size,
                                    const Camera& camera,
                                    const std::optional<TargetPose>& previous = std::nullopt,
                                    const PlanePoseOptions& options = {});

}  // namespace kestrel

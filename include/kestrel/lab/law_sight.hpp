#pragma once

#include <optional>
#include <vector>

#include "kestrel/lab/camera_run.hpp"
#include "kestrel/lab/pixel_noise.hpp"
#include "kestrel/servo/control_law.hpp"

namespace kestrel {

/// What the law is told of the true world: the points with their noise, mis-calibrated and late,
/// depths and translations with their factor, and, for the laws that need one, the pose or the
/// homography that these points give (point_pose, point_homography). Points that are exact give the
/// true pose. Where the points give none, the law is told none.
class LawSight {
 public:
  explicit LawSight(const CameraSetup& setup);

  /// Takes the image of the next step, the true points and pose given; the noise is drawn here.
  /// motion: the twist integrated from the step before to this one (zero for the first).
  void look(const std::vector<Feature>& points, const TargetPose& camera_from_target,
            const Vector6d& motion);

  /// What the law is told at the step last looked at: the image of step max(0, k - delay), and the
  /// camera's motion between that image and the one used a step before.
  const LawInput& told() const;

  /// s* in the true camera: where the points are when the law sees no error, (x0 y0 x1 y1 ...).
  const Eigen::VectorXd& reached() const { return reached_; }

 private:
  ImagePoint believed(const ImagePoint& point) const;
  TargetPose scaled(TargetPose pose) const;
  std::optional<TargetPose> pose_from(const std::vector<Feature>& points,
                                      const TargetPose& true_pose) const;
  void add_geometry(LawInput& input, const TargetPose& true_pose) const;

  CameraSetup setup_;
  PixelNoise noise_;
  std::vector<Feature> desired_;
  std::optional<TargetPose> goal_;  // as believed
  Eigen::VectorXd reached_;
  std::vector<LawInput> images_;  // the last delay + 1, a ring
  int step_ = -1;
};

}  // namespace kestrel

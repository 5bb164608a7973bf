#pragma once

#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/sim/render.hpp"
#include "kestrel/sim/scene.hpp"

namespace kestrel {

/// A flight as a bystander sees it: the scene, the helicopter as lines (fuselage, rotor, what its
/// camera sees), the way it came and where it is to go. For one thread.
class OutsideView {
 public:
  /// Stands beside the way from start to goal (positions of the helicopter, NED, m) so that both
  /// are in view. Throws std::invalid_argument for a scene that does not check, positions that are
  /// not finite, or a size below 64x48.
  OutsideView(const Scene& scene, const Eigen::Vector3d& start_m, const Eigen::Vector3d& goal_m,
              cv::Size size_px);

  /// The picture at time_s, 8-bit BGR. goal_m: where the helicopter is to be by now.
  cv::Mat draw(const Transform<frame::World, frame::Body>& world_from_body,
               const Mount& body_from_camera, const Eigen::Vector3d& goal_m, double time_s);

 private:
  Camera camera_;
  Renderer renderer_;
  Transform<frame::World, frame::Camera> world_from_eye_;
  std::vector<Eigen::Vector3d> path_m_;
};

}  // namespace kestrel

#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/calibration/board.hpp"
#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/rotation.hpp"
#include "kestrel/geometry/transform.hpp"

#include "support/random.hpp"

namespace kestrel::test {

/// The board with its centre in direction (x, y, 1) of the camera at this depth, m, turned by
/// these angles, rad.
inline TargetPose board_pose_at(const Board& board, const ImagePoint& direction, double depth_m,
                                const Eigen::Vector3d& angles) {
  const Eigen::Matrix3d R = rotation_from_rpy(angles.x(), angles.y(), angles.z());
  const std::vector<Eigen::Vector3d> points = board_points(board);
  const Eigen::Vector3d middle = (points.front() + points.back()) / 2;
  return {R, Eigen::Vector3d(direction.x, direction.y, 1) * depth_m - R * middle};
}

/// What a camera sees of the board, with normal noise on each coordinate.
inline BoardView view_of(const Board& board, const Camera& camera, const TargetPose& pose,
                         double noise_px, Random& random) {
  BoardView view;
  int id = 0;
  for (const Eigen::Vector3d& point : board_points(board)) {
    const Eigen::Vector3d p = pose * point;
    Pixel seen = camera.to_pixel({p.x() / p.z(), p.y() / p.z()});
    seen.u += noise_px * random.normal();
    seen.v += noise_px * random.normal();
    view.points.push_back({id++, seen});
  }
  return view;
}

inline bool is_inside(const BoardView& view, const CameraParameters& p) {
  for (const BoardPoint& point : view.points) {
    const Pixel& at = point.in_image;
    constexpr double kNoise_px = 2;  // the points stay inside with noise too
    const bool inside = at.u > kNoise_px && at.v > kNoise_px && at.u < p.width - 1 - kNoise_px &&
                        at.v < p.height - 1 - kNoise_px;
    if (!inside) return false;
  }
  return true;
}

/// `count` poses as somebody takes them who knows how: places all over the image, tilts of 20 to 40
/// degrees to all sides, rolls, near and far; the board always whole in the image.
inline std::vector<TargetPose> usual_poses(const Board& board, const Camera& camera, int count,
                                           Random& random) {
  const CameraParameters& p = camera.parameters();
  const double length_m = board_points(board).back().norm();
  std::vector<TargetPose> poses;
  for (int i = 0; i < count; ++i) {
    const double towards = 2 * M_PI * i * 0.382;
    const double tilt = random.uniform(0.35, 0.7);
    const Eigen::Vector3d angles(tilt * std::cos(towards), tilt * std::sin(towards),
                                 random.uniform(-0.5, 0.5));
    const double depth_m = length_m * random.uniform(0.7, 1.3) * p.px / (0.5 * p.width);
    Pixel at{random.uniform(0, p.width), random.uniform(0, p.height)};
    for (double reach = 1;; reach *= 0.9) {
      const Pixel nearer{p.u0 + reach * (at.u - p.u0), p.v0 + reach * (at.v - p.v0)};
      const TargetPose pose = board_pose_at(board, camera.to_image_point(nearer),
                                            depth_m / std::max(reach, 0.3), angles);
      if (reach > 0.01 && !is_inside(view_of(board, camera, pose, 0, random), p)) continue;
      poses.push_back(pose);
      break;
    }
  }
  return poses;
}

/// Views of the board from usual_poses.
inline std::vector<BoardView> usual_views(const Board& board, const Camera& camera, int count,
                                          double noise_px, Random& random) {
  std::vector<BoardView> views;
  for (const TargetPose& pose : usual_poses(board, camera, count, random)) {
    views.push_back(view_of(board, camera, pose, noise_px, random));
    views.back().name = "view " + std::to_string(views.size());
  }
  return views;
}

/// Cameras of 640 x 480 px as they are sold: one of each lens that a calibration looks for.
inline Camera wide_angle() {
  return Camera({536, 534, 331, 236, 640, 480, Lens::PlumbBob, {-0.27, 0.09, 1e-3, -5e-4, 0}});
}
inline Camera straight() { return Camera({610, 605, 315, 243, 640, 480}); }
inline Camera fisheye() {
  return Camera(
      {285, 286, 322, 238, 640, 480, Lens::KannalaBrandt, {-0.02, 0.004, -0.003, 0.0005, 0}});
}

/// The board as a pinhole camera sees it, 8-bit grey, anti-aliased: dark 30, light 220.
cv::Mat board_picture(const Board& board, const Camera& camera, const TargetPose& pose);

}  // namespace kestrel::test

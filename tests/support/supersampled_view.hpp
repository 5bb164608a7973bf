#pragma once

#include <algorithm>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/sim/scene.hpp"

namespace kestrel::test {

/// Grey level where a ray (World) from a point meets the scene, bilinear in the texture.
inline double light_along(const Scene& scene, const Eigen::Vector3d& from,
                          const Eigen::Vector3d& ray) {
  for (auto plane = scene.planes.rbegin(); plane != scene.planes.rend(); ++plane) {
    const auto target_from_world = plane->world_from_target.inverse();
    const Eigen::Vector3d o = target_from_world * from;
    const Eigen::Vector3d d = target_from_world.rotation * ray;
    if (!(o.z() < 0 && d.z() > 0)) continue;
    const double x = (o.x() - o.z() / d.z() * d.x()) / plane->width_m + 0.5;
    const double y = (o.y() - o.z() / d.z() * d.y()) / plane->height_m + 0.5;
    if (!(x >= 0 && x < 1 && y >= 0 && y < 1)) continue;
    const cv::Mat& texture = plane->texture;
    const double s = std::clamp(x * texture.cols - 0.5, 0.0, texture.cols - 1.0);
    const double t = std::clamp(y * texture.rows - 0.5, 0.0, texture.rows - 1.0);
    const int i = std::min(int(s), texture.cols - 2);
    const int j = std::min(int(t), texture.rows - 2);
    const auto grey = [&](int a, int b) { return double(texture.at<std::uint8_t>(j + b, i + a)); };
    const double above = (i + 1 - s) * grey(0, 0) + (s - i) * grey(1, 0);
    const double below = (i + 1 - s) * grey(0, 1) + (s - i) * grey(1, 1);
    return (j + 1 - t) * above + (t - j) * below;
  }
  return scene.background_grey;
}

/// The view with n x n rays a pixel and nothing clever: float grey levels.
inline cv::Mat supersampled_view(const Scene& scene, const Camera& camera,
                                 const Transform<frame::World, frame::Camera>& world_from_camera,
                                 int n) {
  cv::Mat view(camera.parameters().height, camera.parameters().width, CV_32F);
  for (int v = 0; v < view.rows; ++v) {
    for (int u = 0; u < view.cols; ++u) {
      double sum = 0;
      for (int k = 0; k < n * n; ++k) {
        const double du = (k % n + 0.5) / n - 0.5;
        const double dv = double(k / n) / n + 0.5 / n - 0.5;
        const ImagePoint p = camera.to_image_point({u + du, v + dv});
        sum += light_along(scene, world_from_camera.translation,
                           world_from_camera.rotation * Eigen::Vector3d(p.x, p.y, 1));
      }
      view.at<float>(v, u) = float(sum / (n * n));
    }
  }
  return view;
}

}  // namespace kestrel::test

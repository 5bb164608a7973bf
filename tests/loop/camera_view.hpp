#pragma once

#include <cmath>
#include <cstdint>

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/transform.hpp"

/// Pictures of a painted plane, a ray a pixel: what the loop sees in its tests. Shares nothing with
/// the simulator or the tracker.
namespace kestrel::test {

/// Grey value of the paint at a point of the plane, m: noise of several sizes, smooth.
inline double paint(double x, double y) {
  // Each size has grains of its own: with the same ones the paint would look alike at half the
  // size.
  std::uint64_t octave = 0;
  const auto grain = [&octave](std::int64_t i, std::int64_t j) {
    std::uint64_t h = std::uint64_t(i) * 0x9e3779b97f4a7c15ull ^
                      std::uint64_t(j) * 0xc2b2ae3d27d4eb4full ^ octave * 0xd6e8feb86659fd93ull;
    h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9ull;
    h = (h ^ (h >> 32)) * 0x94d049bb133111ebull;
    return double((h ^ (h >> 31)) >> 11) * 0x1p-53 - 0.5;
  };
  double sum = 0;
  double weight = 1;
  for (double cell = 0.16; cell > 0.015; cell /= 2, weight *= 0.8) {
    ++octave;
    const double u = x / cell;
    const double v = y / cell;
    const auto i = std::int64_t(std::floor(u));
    const auto j = std::int64_t(std::floor(v));
    const auto ease = [](double t) { return t * t * (3 - 2 * t); };
    const double a = ease(u - double(i));
    const double b = ease(v - double(j));
    sum += weight * ((1 - b) * ((1 - a) * grain(i, j) + a * grain(i + 1, j)) +
                     b * ((1 - a) * grain(i, j + 1) + a * grain(i + 1, j + 1)));
  }
  return std::fmin(255, std::fmax(0, 128 + 90 * sum));
}

/// The plane, painted everywhere, as a camera without lens sees it.
inline cv::Mat view(const Camera& camera, const TargetPose& camera_from_target) {
  const CameraParameters& p = camera.parameters();
  const auto target_from_camera = camera_from_target.inverse();
  cv::Mat picture(p.height, p.width, CV_8UC1);
  for (int v = 0; v < p.height; ++v) {
    for (int u = 0; u < p.width; ++u) {
      const Eigen::Vector3d ray((u - p.u0) / p.px, (v - p.v0) / p.py, 1);
      const Eigen::Vector3d turned = target_from_camera.rotation * ray;
      const double along = -target_from_camera.translation.z() / turned.z();
      const Eigen::Vector3d at = target_from_camera.translation + along * turned;
      picture.at<std::uint8_t>(v, u) =
          along > 0 ? std::uint8_t(std::lround(paint(at.x(), at.y()))) : std::uint8_t(0);
    }
  }
  return picture;
}

/// The painted target itself, seen squarely: width_px x height_px pixels that span it edge to edge.
inline cv::Mat target_picture(int width_px, int height_px, double width_m, double height_m) {
  cv::Mat picture(height_px, width_px, CV_8UC1);
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      picture.at<std::uint8_t>(v, u) = std::uint8_t(std::lround(
          paint(((u + 0.5) / width_px - 0.5) * width_m, ((v + 0.5) / height_px - 0.5) * height_m)));
    }
  }
  return picture;
}

}  // namespace kestrel::test

#include "kestrel/calibration/undistortion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

namespace kestrel {
namespace {

/// By how much the focal length is shortened.
double shrinkage(const Camera& camera) {
  const CameraParameters& p = camera.parameters();
  const double farthest = std::tan(70 * M_PI / 180);
  double least = 1;
  const auto see = [&](const Pixel& pixel, double straight) {
    const ImagePoint m = camera.to_image_point(pixel);
    const double seen = std::hypot(m.x, m.y);
    least = std::min(least, straight / (std::isfinite(seen) ? std::min(seen, farthest) : farthest));
  };
  see({0, p.v0}, p.u0 / p.px);
  see({p.width - 1.0, p.v0}, (p.width - 1 - p.u0) / p.px);
  see({p.u0, 0}, p.v0 / p.py);
  see({p.u0, p.height - 1.0}, (p.height - 1 - p.v0) / p.py);
  return least;
}

}  // namespace

cv::Mat undistorted(const cv::Mat& picture, const Camera& camera) {
  const CameraParameters& p = camera.parameters();
  if (picture.empty() || picture.cols != p.width || picture.rows != p.height)
    throw std::invalid_argument("the picture has not the size the camera is calibrated for");
  const double scale = shrinkage(camera);
  cv::Mat from_u(picture.size(), CV_32F);
  cv::Mat from_v(picture.size(), CV_32F);
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      const Pixel from =
          camera.to_pixel({(u - p.u0) / (p.px * scale), (v - p.v0) / (p.py * scale)});
      const bool seen = std::isfinite(from.u) && std::isfinite(from.v);
      from_u.at<float>(v, u) = seen ? float(from.u) : -2.0F;
      from_v.at<float>(v, u) = seen ? float(from.v) : -2.0F;
    }
  }
  cv::Mat out;
  cv::remap(picture, out, from_u, from_v, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  return out;
}

}  // namespace kestrel

#include "kestrel/geometry/camera.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace kestrel {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// OpenCV's model: x_d = x (1 + k1 r^2 + k2 r^4 + k3 r^6) + tangential terms.
Vector2d plumb_bob(const Vector2d& p, const std::array<double, 5>& d) {
  const auto& [k1, k2, p1, p2, k3] = d;
  const double x = p.x();
  const double y = p.y();
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

Matrix2d plumb_bob_jacobian(const Vector2d& p, const std::array<double, 5>& d) {
  const auto& [k1, k2, p1, p2, k3] = d;
  const double x = p.x();
  const double y = p.y();
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2 * (k1 + r2 * (2 * k2 + r2 * 3 * k3));  // d radial / d r2 * 2
  Matrix2d J;
  J << radial + slope * x * x + 2 * p1 * y + 6 * p2 * x, slope * x * y + 2 * p1 * x + 2 * p2 * y,
      slope * x * y + 2 * p1 * x + 2 * p2 * y, radial + slope * y * y + 6 * p1 * y + 2 * p2 * x;
  return J;
}

/// theta_d = theta (1 + k1 theta^2 + ... + k4 theta^8).
double fisheye(double theta, const std::array<double, 5>& k) {
  const double t2 = theta * theta;
  return theta * (1 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
}

double fisheye_slope(double theta, const std::array<double, 5>& k) {
  const double t2 = theta * theta;
  return 1 + t2 * (3 * k[0] + t2 * (5 * k[1] + t2 * (7 * k[2] + t2 * 9 * k[3])));
}

constexpr int kNewtonSteps = 50;
constexpr double kNewtonTolerance = 1e-12;
const Vector2d kNowhere = Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());

Vector2d undo_plumb_bob(const Vector2d& distorted, const std::array<double, 5>& d) {
  Vector2d p = distorted;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Matrix2d J = plumb_bob_jacobian(p, d);
    const double det = J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0);
    if (!(det > 0)) return kNowhere;  // beyond the fold of the lens model
    const Vector2d e = distorted - plumb_bob(p, d);
    const Vector2d step((J(1, 1) * e.x() - J(0, 1) * e.y()) / det,
                        (J(0, 0) * e.y() - J(1, 0) * e.x()) / det);
    p += step;
    if (step.norm() < kNewtonTolerance) return p;
  }
  return kNowhere;
}

Vector2d undo_fisheye(const Vector2d& distorted, const std::array<double, 5>& k) {
  const double theta_d = distorted.norm();
  if (theta_d == 0) return distorted;
  double theta = theta_d;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const double slope = fisheye_slope(theta, k);
    if (!(slope > 0)) return kNowhere;
    const double step = (theta_d - fisheye(theta, k)) / slope;
    theta += step;
    if (std::abs(step) < kNewtonTolerance) {
      if (!(theta > 0 && theta < M_PI / 2)) return kNowhere;
      return distorted * (std::tan(theta) / theta_d);
    }
  }
  return kNowhere;
}

}  // namespace

Camera::Camera(const CameraParameters& parameters) : parameters_(parameters) {
  const CameraParameters& p = parameters_;
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(std::isfinite(p.px) && p.px > 0, "px: the focal length must be positive");
  require(std::isfinite(p.py) && p.py > 0, "py: the focal length must be positive");
  require(std::isfinite(p.u0) && std::isfinite(p.v0), "u0, v0: the principal point must be finite");
  require(p.width >= 0 && p.height >= 0, "the image size must not be negative");
  for (const double d : p.distortion) require(std::isfinite(d), "distortion: must be finite");
}

Eigen::Matrix3d Camera::K() const {
  Eigen::Matrix3d K;
  K << parameters_.px, 0, parameters_.u0, 0, parameters_.py, parameters_.v0, 0, 0, 1;
  return K;
}

Pixel Camera::to_pixel(const ImagePoint& point) const {
  const auto& d = parameters_.distortion;
  Vector2d p(point.x, point.y);
  const double r = p.norm();
  switch (parameters_.lens) {
    case Lens::Pinhole:
      break;
    case Lens::VispRadial:
      p *= 1 + d[0] * r * r;
      break;
    case Lens::PlumbBob:
      p = plumb_bob(p, d);
      break;
    case Lens::KannalaBrandt:
      if (r > 0) p *= fisheye(std::atan(r), d) / r;
      break;
  }
  return {parameters_.px * p.x() + parameters_.u0, parameters_.py * p.y() + parameters_.v0};
}

ImagePoint Camera::to_image_point(const Pixel& pixel) const {
  const auto& d = parameters_.distortion;
  Vector2d p((pixel.u - parameters_.u0) / parameters_.px,
             (pixel.v - parameters_.v0) / parameters_.py);
  switch (parameters_.lens) {
    case Lens::Pinhole:
      break;
    case Lens::VispRadial:
      p *= 1 + d[1] * p.squaredNorm();
      break;
    case Lens::PlumbBob:
      p = undo_plumb_bob(p, d);
      break;
    case Lens::KannalaBrandt:
      p = undo_fisheye(p, d);
      break;
  }
  return {p.x(), p.y()};
}

}  // namespace kestrel

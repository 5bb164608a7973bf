#include "kestrel/geometry/camera.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <Eigen/LU>

#include "lens.hpp"

namespace kestrel {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// A radius (1) on the normalised plane, 0.06 degrees short of 90 degrees off axis.
constexpr double kFarOut = 1000;

/// Up to which radius (an angle, rad, for Kannala-Brandt) the lens model is monotonic.
double outward_range(const CameraParameters& p) {
  const auto& d = p.distortion;
  switch (p.lens) {
    case Lens::Pinhole:
      break;
    case Lens::VispRadial:
      return lens::fold({1, 3 * d[0]}, kFarOut);
    case Lens::PlumbBob:
      return lens::fold({1, 3 * d[0], 5 * d[1], 7 * d[4]}, kFarOut);
    case Lens::KannalaBrandt:
      return lens::fold({1, 3 * d[0], 5 * d[1], 7 * d[2], 9 * d[3]}, M_PI / 2);
  }
  return std::numeric_limits<double>::infinity();
}

/// The same for ViSP's polynomial from pixels to the normalised plane.
double inward_range(const CameraParameters& p) {
  if (p.lens != Lens::VispRadial) return std::numeric_limits<double>::infinity();
  return lens::fold({1, 3 * p.distortion[1]}, kFarOut);
}

constexpr int kNewtonSteps = 50;
constexpr double kNewtonTolerance = 1e-12;
const Vector2d kNowhere = Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());

/// Newton's method, each step shortened until it stays inside the fold and nears the answer: so it
/// can neither end on a branch beyond nor be thrown about by the small slope near the fold.
Vector2d undo_plumb_bob(const Vector2d& distorted, const std::array<double, 5>& d, double range) {
  Vector2d p = distorted;
  if (p.norm() > range / 2) p *= range / 2 / p.norm();
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Vector2d e = distorted - lens::plumb_bob(p, d);
    const Matrix2d J = lens::plumb_bob_jacobian(p, d);
    const double det = J.determinant();
    if (!(det > 0)) return kNowhere;
    Vector2d step((J(1, 1) * e.x() - J(0, 1) * e.y()) / det,
                  (J(0, 0) * e.y() - J(1, 0) * e.x()) / det);
    if (step.norm() < kNewtonTolerance * std::fmax(1, p.norm())) return p + step;
    const auto nears = [&](const Vector2d& next) {
      return next.norm() < range && (distorted - lens::plumb_bob(next, d)).norm() < e.norm();
    };
    for (int halvings = 0; halvings < 20 && !nears(p + step); ++halvings) step /= 2;
    p += step;
  }
  return kNowhere;
}

/// Newton's method between two bounds that close in on the answer.
Vector2d undo_fisheye(const Vector2d& distorted, const std::array<double, 5>& k, double range) {
  const double theta_d = distorted.norm();
  if (theta_d == 0) return distorted;
  if (!(theta_d < lens::fisheye(range, k))) return kNowhere;
  double low = 0;
  double high = range;
  double theta = std::fmin(theta_d, range / 2);
  for (int i = 0; i < kNewtonSteps; ++i) {
    const double e = theta_d - lens::fisheye(theta, k);
    (e > 0 ? low : high) = theta;
    double next = theta + e / lens::fisheye_slope(theta, k);
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    if (std::abs(next - theta) < kNewtonTolerance) return distorted * (std::tan(next) / theta_d);
    theta = next;
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
  outward_range_ = outward_range(p);
  inward_range_ = inward_range(p);
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
      p = r < outward_range_ ? Vector2d(p * (1 + d[0] * r * r)) : kNowhere;
      break;
    case Lens::PlumbBob:
      // The tangential terms bend the edge of the range a little: the determinant has the last
      // word.
      p = r < outward_range_ && lens::plumb_bob_jacobian(p, d).determinant() > 0
              ? lens::plumb_bob(p, d)
              : kNowhere;
      break;
    case Lens::KannalaBrandt:
      if (!(std::atan(r) < outward_range_)) p = kNowhere;
      if (r > 0) p *= lens::fisheye(std::atan(r), d) / r;
      break;
  }
  return {parameters_.px * p.x() + parameters_.u0, parameters_.py * p.y() + parameters_.v0};
}

Matrix2d Camera::pixel_jacobian(const ImagePoint& point) const {
  const auto& d = parameters_.distortion;
  const Vector2d p(point.x, point.y);
  const double r = p.norm();
  Matrix2d J = Matrix2d::Identity();
  switch (parameters_.lens) {
    case Lens::Pinhole:
      break;
    case Lens::VispRadial:
      J += d[0] * (r * r * Matrix2d::Identity() + 2 * p * p.transpose());
      break;
    case Lens::PlumbBob:
      J = lens::plumb_bob_jacobian(p, d);
      break;
    case Lens::KannalaBrandt:
      if (r > 0) {
        // Along the radius d theta_d / dr, across it theta_d / r.
        const double theta = std::atan(r);
        const double across = lens::fisheye(theta, d) / r;
        const double along = lens::fisheye_slope(theta, d) / (1 + r * r);
        J = across * Matrix2d::Identity() + (along - across) / (r * r) * p * p.transpose();
      }
      break;
  }
  return Vector2d(parameters_.px, parameters_.py).asDiagonal() * J;
}

ImagePoint Camera::to_image_point(const Pixel& pixel) const {
  const auto& d = parameters_.distortion;
  Vector2d p((pixel.u - parameters_.u0) / parameters_.px,
             (pixel.v - parameters_.v0) / parameters_.py);
  switch (parameters_.lens) {
    case Lens::Pinhole:
      break;
    case Lens::VispRadial:
      p = p.norm() < inward_range_ ? Vector2d(p * (1 + d[1] * p.squaredNorm())) : kNowhere;
      break;
    case Lens::PlumbBob:
      p = undo_plumb_bob(p, d, outward_range_);
      break;
    case Lens::KannalaBrandt:
      p = undo_fisheye(p, d, outward_range_);
      break;
  }
  return {p.x(), p.y()};
}

}  // namespace kestrel

#include "kestrel/vision/corner_motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace kestrel {
namespace {

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

std::array<double, 8> coordinates_of(const std::array<Pixel, 4>& corners) {
  return {corners[0].u, corners[0].v, corners[1].u, corners[1].v,
          corners[2].u, corners[2].v, corners[3].u, corners[3].v};
}

}  // namespace

void MotionOptions::check() const {
  require(acceleration_px_s2 > 0 && std::isfinite(acceleration_px_s2),
          "motion.acceleration_px_s2: must be above 0");
  require(first_speed_px_s > 0 && std::isfinite(first_speed_px_s),
          "motion.first_speed_px_s: must be above 0");
  require(longest_gap_s > 0 && std::isfinite(longest_gap_s),
          "motion.longest_gap_s: must be above 0");
}

std::array<Pixel, 4> CornerMotion::corners() const {
  std::array<Pixel, 4> at;
  for (std::size_t i = 0; i < 4; ++i) {
    at[i] = {coordinates[2 * i].mean[0], coordinates[2 * i + 1].mean[0]};
  }
  return at;
}

double CornerMotion::deviation_px() const {
  double most = 0;
  for (const CoordinateMotion& c : coordinates) most = std::max(most, c.covariance(0, 0));
  return std::sqrt(most);
}

CornerMotion first_motion(const std::array<Pixel, 4>& corners,
                          const Eigen::Matrix<double, 8, 1>& variances, double stamp_s,
                          const MotionOptions& options) {
  CornerMotion motion;
  motion.stamp_s = stamp_s;
  const auto at = coordinates_of(corners);
  for (std::size_t i = 0; i < 8; ++i) {
    CoordinateMotion& c = motion.coordinates[i];
    c.mean[0] = at[i];
    c.covariance(0, 0) = variances[Eigen::Index(i)];
    c.covariance(1, 1) = options.first_speed_px_s * options.first_speed_px_s;
  }
  return motion;
}

CornerMotion predicted(CornerMotion motion, double stamp_s, const MotionOptions& options) {
  const double t = stamp_s - motion.stamp_s;
  if (!(t > 0) || !std::isfinite(t)) return motion;
  motion.stamp_s = stamp_s;
  Eigen::Matrix2d F;
  F << 1, t, 0, 1;
  // An acceleration that is constant within the gap and independent from gap to gap
  // (Bar-Shalom, Li & Kirubarajan 2001, section 6.3.2).
  const Eigen::Vector2d G(t * t / 2, t);
  const double q = options.acceleration_px_s2 * options.acceleration_px_s2;
  for (CoordinateMotion& c : motion.coordinates) {
    if (t > options.longest_gap_s) c.mean[1] = 0;  // whatever it did has long ended
    c.mean = (F * c.mean).eval();
    c.covariance = (F * c.covariance * F.transpose() + q * G * G.transpose()).eval();
  }
  return motion;
}

CornerMotion corrected(CornerMotion motion, const std::array<Pixel, 4>& corners,
                       const Eigen::Matrix<double, 8, 1>& variances) {
  const auto at = coordinates_of(corners);
  for (std::size_t i = 0; i < 8; ++i) {
    CoordinateMotion& c = motion.coordinates[i];
    const double innovation = c.covariance(0, 0) + variances[Eigen::Index(i)];
    const Eigen::Vector2d gain = c.covariance.col(0) / innovation;
    c.mean += gain * (at[i] - c.mean[0]);
    c.covariance -= gain * c.covariance.row(0).eval();
  }
  return motion;
}

PixelBox gate(const CornerMotion& motion, double deviations) {
  double left = INFINITY;
  double top = INFINITY;
  double right = -INFINITY;
  double bottom = -INFINITY;
  for (std::size_t i = 0; i < 8; ++i) {
    const CoordinateMotion& c = motion.coordinates[i];
    const double reach = deviations * std::sqrt(c.covariance(0, 0));
    double& low = i % 2 == 0 ? left : top;
    double& high = i % 2 == 0 ? right : bottom;
    low = std::min(low, c.mean[0] - reach);
    high = std::max(high, c.mean[0] + reach);
  }
  return {left, top, right - left, bottom - top};
}

}  // namespace kestrel

#include "kestrel/vision/outline_deviation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>

namespace kestrel {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kLeastNoisePx = 0.5;

using Jacobian = Eigen::Matrix<double, 2, 8>;
using Information = Eigen::Matrix<double, 8, 8>;

/// Homography from the template scaled to [-1, 1] x [-1, 1], so that its eight parameters are of
/// like size, with its last element 1.
struct Scaled {
  Eigen::Matrix3d G;
  double half_width;
  double half_height;

  Eigen::Vector3d scaled(const Pixel& p) const {
    return {p.u / half_width - 1, p.v / half_height - 1, 1};
  }

  /// Derivative of the image of a point, px, by the eight parameters of eq. (4).
  Jacobian jacobian(const Pixel& in_template) const {
    const Eigen::Vector3d p = scaled(in_template);
    const Eigen::Vector3d q = G * p;
    const double x = p.x() / q.z();
    const double y = p.y() / q.z();
    const double one = 1 / q.z();
    const double u = q.x() / q.z();
    const double v = q.y() / q.z();
    Jacobian J;
    J << x, y, one, 0, 0, 0, -x * u, -y * u,  //
        0, 0, 0, x, y, one, -x * v, -y * v;
    return J;
  }
};

Scaled scale(const Homography& image_from_template, double width_px, double height_px) {
  const double half_width = (width_px - 1) / 2;
  const double half_height = (height_px - 1) / 2;
  Eigen::Matrix3d T;
  T << half_width, 0, half_width, 0, half_height, half_height, 0, 0, 1;
  const Eigen::Matrix3d G = image_from_template.H * T;
  return {G / G(2, 2), half_width, half_height};
}

/// Variance of a coordinate, px^2, from the residuals: 2n numbers, eight of them spent on the fit.
double noise(const Homography& image_from_template, const std::vector<PixelPair>& inliers) {
  double sum = 0;
  for (const PixelPair& pair : inliers) {
    const double d = distance(image_from_template * pair.in_template, pair.in_image);
    sum += d * d;
  }
  const double freedom = 2.0 * double(inliers.size()) - 8;
  return std::max(kLeastNoisePx * kLeastNoisePx, freedom > 0 ? sum / freedom : 0);
}

}  // namespace

double outline_deviation_px(const Homography& image_from_template,
                            const std::vector<PixelPair>& inliers, double width_px,
                            double height_px) {
  const Scaled model = scale(image_from_template, width_px, height_px);
  Information M = Information::Zero();
  for (const PixelPair& pair : inliers) {
    const Jacobian J = model.jacobian(pair.in_template);
    M.noalias() += J.transpose() * J;
  }
  const Eigen::LLT<Information> factor(M);
  if (inliers.size() < 4 || factor.info() != Eigen::Success) return kInfinite;
  double sum = 0;
  for (const Pixel& corner : template_corners(width_px, height_px)) {
    const Jacobian J = model.jacobian(corner);
    sum += (J * factor.solve(J.transpose())).trace();
  }
  const double variance = noise(image_from_template, inliers) * sum / 4;
  return variance >= 0 ? std::sqrt(variance) : kInfinite;  // infinite for not a number, too
}

}  // namespace kestrel

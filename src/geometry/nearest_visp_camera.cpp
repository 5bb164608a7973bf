#include "kestrel/geometry/nearest_visp_camera.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <Eigen/Cholesky>

namespace kestrel {
namespace {

constexpr int kColumns = 33;
constexpr int kRows = 25;
constexpr int kSteps = 20;  // Gauss-Newton on a nearly linear problem: five are enough

/// A pixel of the image and the point that appears there.
struct Sight {
  Pixel pixel;
  Eigen::Vector2d point;
};

std::vector<Sight> sights(const Camera& camera) {
  const CameraParameters& p = camera.parameters();
  std::vector<Sight> all;
  for (int i = 0; i < kColumns * kRows; ++i) {
    const int row = i / kColumns;
    const Pixel pixel{(p.width - 1.0) * (i % kColumns) / (kColumns - 1),
                      (p.height - 1.0) * row / (kRows - 1)};
    const ImagePoint point = camera.to_image_point(pixel);
    if (std::isfinite(point.x) && std::isfinite(point.y))
      all.push_back({pixel, {point.x, point.y}});
  }
  return all;
}

/// One step of Gauss-Newton on u = px x (1 + kud r^2) + u0 and the same for v.
void improve(CameraParameters& p, const std::vector<Sight>& all) {
  using Vector5d = Eigen::Matrix<double, 5, 1>;  // px, py, u0, v0, kud
  Eigen::Matrix<double, 5, 5> A = Eigen::Matrix<double, 5, 5>::Zero();
  Vector5d b = Vector5d::Zero();
  double& kud = p.distortion[0];
  for (const Sight& sight : all) {
    const double r2 = sight.point.squaredNorm();
    const Eigen::Vector2d bent = sight.point * (1 + kud * r2);
    const Vector5d row_u =
        (Vector5d() << bent.x(), 0, 1, 0, p.px * sight.point.x() * r2).finished();
    const Vector5d row_v =
        (Vector5d() << 0, bent.y(), 0, 1, p.py * sight.point.y() * r2).finished();
    A += row_u * row_u.transpose() + row_v * row_v.transpose();
    b += row_u * (sight.pixel.u - p.px * bent.x() - p.u0) +
         row_v * (sight.pixel.v - p.py * bent.y() - p.v0);
  }
  const Vector5d step = A.ldlt().solve(b);
  p.px += step[0];
  p.py += step[1];
  p.u0 += step[2];
  p.v0 += step[3];
  kud += step[4];
}

/// kdu of point = bent (1 + kdu |bent|^2), linear least squares.
double inverse_coefficient(const CameraParameters& p, const std::vector<Sight>& all) {
  double numerator = 0;
  double denominator = 0;
  for (const Sight& sight : all) {
    const Eigen::Vector2d bent((sight.pixel.u - p.u0) / p.px, (sight.pixel.v - p.v0) / p.py);
    const double r2 = bent.squaredNorm();
    numerator += r2 * bent.dot(sight.point - bent);
    denominator += r2 * r2 * r2;
  }
  return denominator > 0 ? numerator / denominator : 0;
}

}  // namespace

NearestVispCamera nearest_visp_camera(const Camera& camera) {
  CameraParameters p = camera.parameters();
  if (p.lens != Lens::PlumbBob) return {p, 0};
  if (p.width == 0 || p.height == 0) {
    throw std::invalid_argument("the size of the image must be known to fit ViSP's lens model");
  }
  const std::vector<Sight> all = sights(camera);
  p.lens = Lens::VispRadial;
  p.distortion = {};
  for (int i = 0; i < kSteps; ++i) improve(p, all);
  p.distortion[1] = inverse_coefficient(p, all);
  NearestVispCamera nearest{p, 0};
  const Camera fitted(p);
  for (const Sight& sight : all) {
    const Pixel there = fitted.to_pixel({sight.point.x(), sight.point.y()});
    nearest.largest_px = std::max(nearest.largest_px, distance(there, sight.pixel));
  }
  return nearest;
}

}  // namespace kestrel

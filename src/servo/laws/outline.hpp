#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "kestrel/servo/feature.hpp"

#include "pseudo_inverse.hpp"

/// The target's outline as an area: what laws without correspondence of depths look at.
namespace kestrel::laws {

/// Indices of the points that make the convex outline of the desired view, in order. A plane's
/// outline has the same points in every view from the front, so the desired order serves the
/// measured points too.
std::vector<std::size_t> outline_order(const std::vector<Feature>& desired);

/// Moments of the area within an outline, of the density one (ViSP: DENSE_POLYGON).
class Outline {
 public:
  Outline(const std::vector<Feature>& points, const std::vector<std::size_t>& order);

  double area() const { return area_; }                      // not negative
  const Eigen::Vector2d& centre() const { return centre_; }  // of gravity
  /// Central moment mu_pq, p + q <= 4.
  double mu(int p, int q) const { return mu_[std::size_t(p)][std::size_t(q)]; }

 private:
  double area_ = 0;
  Eigen::Vector2d centre_ = Eigen::Vector2d::Zero();
  std::array<std::array<double, 5>, 5> mu_{};
};

/// 1/Z = A x + B y + C: the plane's depth over the normalised image.
struct PlaneDepth {
  double A = 0, B = 0, C = 0;

  double inverse_depth_at(const Eigen::Vector2d& p) const { return A * p.x() + B * p.y() + C; }
};

/// The plane of points with depths, least squares; for at least three points not on a line.
PlaneDepth plane_depth(const std::vector<Feature>& points);

}  // namespace kestrel::laws

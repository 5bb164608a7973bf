#pragma once

#include <array>

#include <Eigen/Core>

#include "outline.hpp"

/// How an outline moves in the image while the camera does.
namespace kestrel::laws {

/// A polynomial of second degree in (X, Y), the image about a centre: 1, X, Y, X^2, XY, Y^2.
using Quadratic = std::array<double, 6>;

/// Velocity of the points of a plane in the image under a unit of one of the camera's velocities.
struct ImageField {
  Eigen::Vector2d centre;
  Quadratic x{};
  Quadratic y{};

  /// At an image point, 1/s.
  Eigen::Vector2d at(const Eigen::Vector2d& p) const;
};

/// The field of vx, vy, vz, wx, wy or wz (axis 0 to 5) for points on a plane: the rows of a point's
/// interaction matrix with 1/Z = A x + B y + C put in.
ImageField image_field(int axis, const PlaneDepth& plane, const Eigen::Vector2d& centre);

/// Rates of area, centre of gravity and central moments of third order.
struct OutlineRates {
  double area = 0;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double mu30 = 0, mu21 = 0, mu12 = 0, mu03 = 0;
};

/// Those of an area in a field about its centre: the transport theorem,
/// d/dt int f = int grad f . v + f div v (Chaumette 2004, eq. 7).
OutlineRates outline_rates(const Outline& outline, const ImageField& field);

}  // namespace kestrel::laws

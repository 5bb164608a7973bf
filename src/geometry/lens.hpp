#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Core>

/// The lens models' formulas on the normalised plane, and where each stops being monotonic.
namespace kestrel::lens {

/// OpenCV's model: x_d = x (1 + k1 r^2 + k2 r^4 + k3 r^6) + tangential terms.
inline Eigen::Vector2d plumb_bob(const Eigen::Vector2d& p, const std::array<double, 5>& d) {
  const auto& [k1, k2, p1, p2, k3] = d;
  const double x = p.x();
  const double y = p.y();
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

inline Eigen::Matrix2d plumb_bob_jacobian(const Eigen::Vector2d& p,
                                          const std::array<double, 5>& d) {
  const auto& [k1, k2, p1, p2, k3] = d;
  const double x = p.x();
  const double y = p.y();
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2 * (k1 + r2 * (2 * k2 + r2 * 3 * k3));  // d radial / d r2 * 2
  Eigen::Matrix2d J;
  J << radial + slope * x * x + 2 * p1 * y + 6 * p2 * x, slope * x * y + 2 * p1 * x + 2 * p2 * y,
      slope * x * y + 2 * p1 * x + 2 * p2 * y, radial + slope * y * y + 6 * p1 * y + 2 * p2 * x;
  return J;
}

/// theta_d = theta (1 + k1 theta^2 + ... + k4 theta^8).
inline double fisheye(double theta, const std::array<double, 5>& k) {
  const double t2 = theta * theta;
  return theta * (1 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
}

inline double fisheye_slope(double theta, const std::array<double, 5>& k) {
  const double t2 = theta * theta;
  return 1 + t2 * (3 * k[0] + t2 * (5 * k[1] + t2 * (7 * k[2] + t2 * 9 * k[3])));
}

inline double value(const std::vector<double>& polynomial, double s) {
  double sum = 0;
  for (auto c = polynomial.rbegin(); c != polynomial.rend(); ++c) sum = sum * s + *c;
  return sum;
}

/// Where the polynomial (constant term first) changes its sign in (0, end), in order: between two
/// neighbours among the sign changes of its derivative it is monotonic, and bisection finds them.
inline std::vector<double> sign_changes(const std::vector<double>& polynomial, double end) {
  if (polynomial.size() < 2) return {};
  std::vector<double> derivative;
  for (std::size_t i = 1; i < polynomial.size(); ++i) derivative.push_back(i * polynomial[i]);
  std::vector<double> stops = sign_changes(derivative, end);
  stops.push_back(end);
  std::vector<double> roots;
  double low = 0;
  for (const double stop : stops) {
    double a = low;
    double b = stop;
    const bool sign = value(polynomial, a) > 0;
    low = stop;
    if ((value(polynomial, b) > 0) == sign) continue;
    for (int i = 0; i < 100; ++i) {
      const double middle = (a + b) / 2;
      ((value(polynomial, middle) > 0) == sign ? a : b) = middle;
    }
    roots.push_back(a);
  }
  return roots;
}

/// Square root of the first root of 1 + c1 s + c2 s^2 + ..., the slope of a radial lens model over
/// s = radius^2; `end` when there is none before it.
inline double fold(const std::vector<double>& slope, double end) {
  const std::vector<double> roots = sign_changes(slope, end * end);
  return roots.empty() ? end : std::sqrt(roots.front());
}

}  // namespace kestrel::lens

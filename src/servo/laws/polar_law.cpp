#include <cmath>

#include "kestrel/geometry/rotation.hpp"

#include "laws.hpp"
#include "pseudo_inverse.hpp"

namespace kestrel::laws {
namespace {

/// A point nearer to the optical axis has no angle. Only what is the axis to rounding: the law
/// hovers there for good, while a little beside it is bad but moves on.
constexpr double kSmallestRadius = 1e-9;

bool has_angle(const ImagePoint& p) { return std::hypot(p.x, p.y) > kSmallestRadius; }

/// Rows of (rho, theta) of a point (ViSP: vpFeaturePointPolar; Iwatsuki & Okiyama 2005).
Eigen::Matrix<double, 2, 6> polar_rows(const Feature& point) {
  const double rho = std::hypot(point.at.x, point.at.y);
  const double c = point.at.x / rho;
  const double s = point.at.y / rho;
  const double w = 1 / point.depth_m;
  Eigen::Matrix<double, 2, 6> rows;
  rows << -c * w, -s * w, rho * w, (1 + rho * rho) * s, -(1 + rho * rho) * c, 0,  //
      s * w / rho, -c * w / rho, 0, c / rho, s / rho, -1;
  return rows;
}

}  // namespace

/// -gain L^+ e with e = (rho - rho*, theta - theta*), the angles wrapped: a turn about the optical
/// axis is one in theta, without retreat. Singular where a point is on the axis.
LawAnswer polar_law(const LawInput& input, const LawOptions& options) {
  const auto n = Eigen::Index(input.measured.size());
  TaskJacobian L(2 * n, 6);
  Eigen::VectorXd error(2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ImagePoint& now = input.measured[std::size_t(i)].at;
    const ImagePoint& goal = input.desired[std::size_t(i)].at;
    if (!has_angle(now) || !has_angle(goal)) return refused(LawRefusal::Singular);
    L.middleRows<2>(2 * i) = polar_rows(input.measured[std::size_t(i)]);
    error[2 * i] = std::hypot(now.x, now.y) - std::hypot(goal.x, goal.y);
    error[2 * i + 1] = wrap_angle(std::atan2(now.y, now.x) - std::atan2(goal.y, goal.x));
  }
  return solved(L, error, input, options);
}

}  // namespace kestrel::laws

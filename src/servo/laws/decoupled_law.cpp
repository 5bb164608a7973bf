#include <cmath>

#include "closed_form.hpp"
#include "laws.hpp"
#include "outline.hpp"
#include "point_features.hpp"

namespace kestrel::laws {
namespace {

/// Centre of gravity of the points themselves.
Eigen::Vector2d mean_point(const std::vector<Feature>& points) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Feature& f : points) sum += Eigen::Vector2d(f.at.x, f.at.y);
  return sum / double(points.size());
}

}  // namespace

/// The three references of a helicopter (Mejias, Saripalli, Campoy & Sukhatme 2006, in metric
/// form), in the camera's axes: Zh = Z* sqrt(a*/a), vx = gain Zh (xg - xg*), vy = gain Zh (yg -
/// yg*), vz = gain (Zh - Z*); no rates. What it inverts is -I.
LawAnswer decoupled_law(const LawInput& input, const LawOptions& options) {
  if (input.measured.size() < 4) return refused(LawRefusal::FewPoints);
  const auto order = outline_order(input.desired);
  const double goal_depth_m = mean_depth(input.desired);
  const double depth_m = goal_depth_m * std::sqrt(Outline(input.desired, order).area() /
                                                  Outline(input.measured, order).area());
  if (!std::isfinite(depth_m)) return refused(LawRefusal::Singular);
  const Eigen::Vector2d offset = mean_point(input.measured) - mean_point(input.desired);
  const Eigen::Vector3d error(depth_m * offset.x(), depth_m * offset.y(), depth_m - goal_depth_m);
  Vector6d u = Vector6d::Zero();
  u.head<3>() = -error;
  return closed_form(u, error, Eigen::VectorXd::Ones(3), input, options);
}

}  // namespace kestrel::laws

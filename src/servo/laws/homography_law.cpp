#include <algorithm>
#include <functional>
#include <vector>

#include "kestrel/geometry/point_homography.hpp"

#include "closed_form.hpp"
#include "laws.hpp"
#include "point_features.hpp"

namespace kestrel::laws {
namespace {

/// The matrix the law inverts: that of (e_v, e_w) at a small distance from the goal, the coupling
/// of rotation and translation left out: -diag(1/Z*, 1/Z*, 1/Z*, 2, 2, 2).
Eigen::VectorXd assumed_values(double depth_m) {
  Vector6d values = (Vector6d() << 2, 2, 2, 1 / depth_m, 1 / depth_m, 1 / depth_m).finished();
  std::sort(values.begin(), values.end(), std::greater<>());
  return values;
}

}  // namespace

/// Benhimane & Malis 2007: e_v = (H - I) m*, e_w = vex(H - H^T), v = gain Z* e_v, w = gain e_w / 2
/// with H from the goal's image to the current one, Euclidean, and m* = (0, 0, 1). Z* only sets the
/// gain of the translation.
LawAnswer homography_law(const LawInput& input, const LawOptions& options) {
  if (!input.camera_from_goal_homography) return refused(LawRefusal::Homography);
  std::vector<ImagePoint> goal;
  goal.reserve(input.desired.size());
  for (const Feature& f : input.desired) goal.push_back(f.at);
  const auto euclidean = euclidean_homography(*input.camera_from_goal_homography, goal);
  if (!euclidean) return refused(LawRefusal::Homography);
  const Eigen::Matrix3d& H = *euclidean;
  const Eigen::Vector3d ev = H.col(2) - Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d ew(H(2, 1) - H(1, 2), H(0, 2) - H(2, 0), H(1, 0) - H(0, 1));
  const double depth_m = mean_depth(input.desired);
  const Vector6d error = (Vector6d() << ev, ew).finished();
  const Vector6d u = (Vector6d() << -depth_m * ev, -ew / 2).finished();
  return closed_form(u, error, assumed_values(depth_m), input, options);
}

}  // namespace kestrel::laws

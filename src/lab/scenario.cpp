#include "kestrel/lab/scenario.hpp"

#include <cmath>
#include <stdexcept>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

constexpr double kRotationTolerance = 1e-6;  // a pose typed with seven digits passes

void check_pose(const std::string& scenario, const char* which, const TargetPose& pose) {
  if (!pose.translation.allFinite() || !(rotation_defect(pose.rotation) < kRotationTolerance)) {
    throw std::invalid_argument("scenario " + scenario + ": " + which + " is not a pose");
  }
}

void demand(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("camera: ") + what);
}

}  // namespace

void Scenario::check() const {
  if (points_m.empty()) throw std::invalid_argument("scenario " + name + ": no point");
  for (const Eigen::Vector3d& point : points_m) {
    if (!point.allFinite()) {
      throw std::invalid_argument("scenario " + name + ": a point is not finite");
    }
  }
  check_pose(name, "goal", goal);
  check_pose(name, "start", start);
}

Scenario scenario_from(const std::string& name, const std::vector<Eigen::Vector3d>& points_m,
                       const TargetPose& goal, const GoalFromCamera& start_in_goal) {
  return {name, points_m, goal, start_in_goal.inverse() * goal};
}

void LabCamera::check() const {
  demand(std::isfinite(focal_px) && focal_px > 0, "focal_px must be above 0");
  demand(std::isfinite(principal_u_px), "principal_u_px must be finite");
  demand(std::isfinite(principal_v_px), "principal_v_px must be finite");
  demand(width_px > 0, "width_px must be above 0");
  demand(height_px > 0, "height_px must be above 0");
}

std::vector<Eigen::Vector3d> square_points(double side_m) {
  const double h = side_m / 2;
  return {{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}};
}

std::vector<Feature> seen_points(const TargetPose& camera_from_target,
                                 const std::vector<Eigen::Vector3d>& points_m) {
  std::vector<Feature> seen;
  seen.reserve(points_m.size());
  for (const Eigen::Vector3d& point : points_m) {
    const Eigen::Vector3d p = camera_from_target * point;
    seen.push_back({{p.x() / p.z(), p.y() / p.z()}, p.z()});
  }
  return seen;
}

Eigen::Vector3d centre_of(const std::vector<Eigen::Vector3d>& points_m) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points_m) sum += point;
  return sum / double(points_m.size());
}

}  // namespace kestrel

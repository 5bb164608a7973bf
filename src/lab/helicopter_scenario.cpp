#include "kestrel/lab/helicopter_scenario.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/lab/scenario.hpp"

namespace kestrel {
namespace {

constexpr double kRotationTolerance = 1e-6;

void demand(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("scenario: " + what);
}

bool is_rotation(const Eigen::Matrix3d& R) { return rotation_defect(R) <= kRotationTolerance; }

/// Orientation of the helicopter at the goal, in World.
Eigen::Matrix3d body_at_goal(const HelicopterScenario& s) {
  return s.world_from_target.rotation * s.goal.rotation.transpose() *
         s.body_from_camera.rotation.transpose();
}

HelicopterScenario before_the_wall(const std::string& name, double yaw_rad) {
  HelicopterScenario s;
  s.name = name;
  s.points_m = square_points(1.0);
  s.body_from_camera = forward_camera({0.3, 0, 0.1});
  s.goal.translation = {0, 0, 5};
  s.start_camera_m = {-9, 1.5, 1.0};
  s.start_yaw_rad = yaw_rad;
  return s;
}

}  // namespace

Mount forward_camera(const Eigen::Vector3d& place_m) {
  Eigen::Matrix3d R;
  R << 0, 0, 1,  //
      1, 0, 0,   //
      0, 1, 0;
  return {R, place_m};
}

Mount down_camera(const Eigen::Vector3d& place_m) {
  Eigen::Matrix3d R;
  R << 0, -1, 0,  //
      1, 0, 0,    //
      0, 0, 1;
  return {R, place_m};
}

Transform<frame::World, frame::Target> wall() {
  return {forward_camera().rotation, Eigen::Vector3d::Zero()};
}

void HelicopterScenario::check() const {
  demand(!points_m.empty(), "there must be a point");
  demand(std::all_of(points_m.begin(), points_m.end(),
                     [](const Eigen::Vector3d& p) { return p.allFinite(); }),
         "points_m must be finite");
  demand(is_rotation(world_from_target.rotation) && world_from_target.translation.allFinite(),
         "world_from_target must be a pose");
  demand(target_velocity_m_s.allFinite(), "target_velocity_m_s must be finite");
  demand(is_rotation(body_from_camera.rotation) && body_from_camera.translation.allFinite(),
         "body_from_camera must be a pose");
  demand(is_rotation(goal.rotation) && goal.translation.allFinite(), "goal must be a pose");
  demand(start_camera_m.allFinite(), "start_camera_m must be finite");
  demand(std::isfinite(start_yaw_rad), "start_yaw_rad must be finite");
  const Eigen::Vector3d down = body_at_goal(*this).col(2);
  demand((down - Eigen::Vector3d::UnitZ()).norm() <= kRotationTolerance,
         "the helicopter must be level at the goal");
}

double goal_heading(const HelicopterScenario& scenario) {
  const Eigen::Vector3d ahead = body_at_goal(scenario).col(0);
  return std::atan2(ahead.y(), ahead.x());
}

HelicopterScenario helicopter_h0() { return before_the_wall("H0", 0); }

HelicopterScenario helicopter_h1() { return before_the_wall("H1", -12 * M_PI / 180); }

const std::vector<HelicopterScenario>& helicopter_scenarios() {
  static const std::vector<HelicopterScenario> all = {helicopter_h0(), helicopter_h1()};
  return all;
}

}  // namespace kestrel

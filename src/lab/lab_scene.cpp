#include "kestrel/lab/lab_scene.hpp"

#include <Eigen/Geometry>

namespace kestrel {
namespace {

void add_image(LabScene& scene, const TargetPose& goal,
               const std::vector<Eigen::Vector3d>& points_m, const LabCamera& camera) {
  for (const Feature& feature : seen_points(goal, points_m))
    scene.goal_px.push_back(camera.to_pixel(feature.at));
  scene.focal_px = camera.focal_px;
  scene.width_px = camera.width_px;
  scene.height_px = camera.height_px;
}

}  // namespace

LabScene scene_of(const Scenario& scenario, const LabCamera& camera,
                  const std::optional<CameraLimits>& limits) {
  LabScene scene;
  scene.scenario = scenario.name;
  const GoalFromCamera start = scenario.start_in_goal();
  scene.start.origin_m = start.translation;
  scene.start.axes = start.rotation;
  for (const Eigen::Vector3d& p_in_target : scenario.points_m)
    scene.points_m.push_back(scenario.goal * p_in_target);
  add_image(scene, scenario.goal, scenario.points_m, camera);
  if (!limits) return scene;
  for (const char* column : {"vx_m_s", "vy_m_s", "vz_m_s"})
    scene.limits.emplace_back(column, limits->linear_m_s);
  for (const char* column : {"wx_rad_s", "wy_rad_s", "wz_rad_s"})
    scene.limits.emplace_back(column, limits->angular_rad_s);
  return scene;
}

LabScene scene_of(const HelicopterScenario& scenario, const LabCamera& camera,
                  const std::optional<CommandLimits>& limits) {
  LabScene scene;
  scene.scenario = scenario.name;
  scene.kind = RunKind::Helicopter;
  for (const Eigen::Vector3d& p_in_target : scenario.points_m)
    scene.points_m.push_back(scenario.world_from_target * p_in_target);
  const auto goal = scenario.world_from_target * scenario.goal.inverse();
  scene.goal.origin_m = goal.translation;
  scene.goal.axes = goal.rotation;
  scene.start.origin_m = scenario.start_camera_m;
  scene.start.axes = Eigen::AngleAxisd(scenario.start_yaw_rad, Eigen::Vector3d::UnitZ()) *
                     scenario.body_from_camera.rotation;
  add_image(scene, scenario.goal, scenario.points_m, camera);
  if (!limits) return scene;
  const VelocityCommand& speed = limits->speed;
  scene.limits = {{"forward_m_s", speed.forward_m_s},
                  {"right_m_s", speed.right_m_s},
                  {"down_m_s", speed.down_m_s},
                  {"yaw_rate_rad_s", speed.yaw_rate_rad_s}};
  return scene;
}

}  // namespace kestrel

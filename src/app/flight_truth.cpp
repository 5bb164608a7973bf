#include "flight_truth.hpp"

#include <cmath>

#include <fmt/format.h>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/io/csv.hpp"
#include "kestrel/sim/vehicle.hpp"

namespace kestrel::app {
namespace {

double yaw_of(const Eigen::Matrix3d& world_from_body) {
  return std::atan2(world_from_body(1, 0), world_from_body(0, 0));
}

}  // namespace

Transform<frame::World, frame::Body> goal_in_world(
    const Task& task, const Transform<frame::World, frame::Target>& target) {
  return target * task.goal.inverse() * task.body_from_camera.inverse();
}

FlightSample flight_sample(const FlightMoment& now, const Task& task) {
  const auto goal = goal_in_world(task, now.target);
  const auto target_from_camera = now.target.inverse() * now.body * task.body_from_camera;
  FlightSample s;
  s.stamp_s = now.stamp_s;
  s.position_error_m = (now.body.translation - goal.translation).norm();
  s.heading_error_rad = wrap_angle(yaw_of(now.body.rotation) - yaw_of(goal.rotation));
  s.target_distance_m = -target_from_camera.translation.z();
  return s;
}

std::vector<double> truth_values(const FlightMoment& now, const Task& task) {
  const auto goal = goal_in_world(task, now.target);
  const Eigen::Vector3d& p = now.body.translation;
  const Attitude a = attitude(now.body);
  const Eigen::Matrix3d turn = goal.rotation.transpose() * now.body.rotation;
  return {p.x(),
          p.y(),
          p.z(),
          a.roll,
          a.pitch,
          a.yaw,
          (p - goal.translation).norm(),
          rotation_vector(turn).norm()};
}

std::string tum_line(double stamp_s, const Transform<frame::World, frame::Body>& pose) {
  const Eigen::Vector3d& p = pose.translation;
  const Eigen::Vector3d theta_u = rotation_vector(pose.rotation);
  const double angle = theta_u.norm();
  const Eigen::Vector3d v =
      angle > 0 ? Eigen::Vector3d(theta_u / angle * std::sin(angle / 2)) : Eigen::Vector3d::Zero();
  return fmt::format("{} {} {} {} {} {} {} {}", number(stamp_s), number(p.x()), number(p.y()),
                     number(p.z()), number(v.x()), number(v.y()), number(v.z()),
                     number(std::cos(angle / 2)));
}

void add_flight(Summary& summary, const HoverMetrics& m) {
  summary.begin_section("flight");
  summary.add("result", name(m.end));
  summary.add("settled after", m.settled_s.value_or(std::nan("")), "s");
  summary.add("final position error", m.final_position_m, "m");
  summary.add("final heading error", m.final_heading_rad * 180 / M_PI, "deg");
  summary.add("target seen", m.seen_share * 100, "%");
  summary.add("longest time unseen", m.longest_unseen_s, "s");
}

}  // namespace kestrel::app

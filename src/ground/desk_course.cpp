// What GroundDesk does to the course: gain, law, limits, goal and template.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "kestrel/geometry/plane_pose.hpp"
#include "kestrel/geometry/straight_view.hpp"
#include "kestrel/ground/ground_desk.hpp"
#include "kestrel/vision/straight_template.hpp"

namespace kestrel {
namespace {

Answer refused(const std::string& words) { return {Answer::Kind::Refused, words}; }
Answer done(const std::string& words) { return {Answer::Kind::Done, words}; }

double degrees(double rad) { return rad * 180 / M_PI; }

}  // namespace

/// A task that its check refuses changes nothing.
Answer GroundDesk::steer(const Task& task, std::optional<Tracker> tracker,
                         const std::string& words) {
  try {
    task.check();
  } catch (const std::invalid_argument& error) {
    return refused(error.what());
  }
  task_ = task;
  if (!tracker && course_) tracker = std::move(course_->tracker);  // not yet fetched
  course_.emplace(Course{task_, std::move(tracker)});
  tell(words);
  return done(words);
}

Answer GroundDesk::set_gain(double gain_per_s) {
  if (gain_per_s > most_gain_per_s_) {
    return refused(fmt::format("the task allows a gain of {:.3g} 1/s at most", most_gain_per_s_));
  }
  Task task = task_;
  const double share = gain_per_s / task.servo.gain_per_s;
  task.servo.gain_per_s = gain_per_s;
  if (task.servo.far_gain_per_s) *task.servo.far_gain_per_s *= share;
  return steer(task, std::nullopt, fmt::format("gain {:.3g} 1/s", gain_per_s));
}

Answer GroundDesk::set_law(const std::string& word) {
  const auto law = law_named(word);
  if (!law) return refused("there is no law of that name");
  Task task = task_;
  task.servo.law = *law;
  return steer(task, std::nullopt, fmt::format("law {}", word));
}

Answer GroundDesk::set_limits(const VelocityCommand& speed) {
  constexpr double kRounding = 1e-6;  // of degrees to radians and back, in a page
  const Eigen::Array4d most = most_speed_.vector().array();
  if ((speed.vector().array() > most * (1 + kRounding)).any()) {
    return refused(fmt::format(
        "the task allows {:.3g} m/s forward, {:.3g} right, {:.3g} down and {:.3g} deg/s at most",
        most[0], most[1], most[2], degrees(most[3])));
  }
  Task task = task_;
  task.limits.speed = VelocityCommand::from_vector(speed.vector().array().min(most).matrix());
  const VelocityCommand& v = task.limits.speed;
  return steer(task, std::nullopt,
               fmt::format("at most {:.3g} m/s forward, {:.3g} right, {:.3g} down, {:.3g} deg/s",
                           v.forward_m_s, v.right_m_s, v.down_m_s, degrees(v.yaw_rate_rad_s)));
}

Answer GroundDesk::set_goal(const VehiclePlace& place) {
  Task task = task_;
  task.goal = seen_from(place, task_.body_from_camera,
                        level_from_target(task_.goal, task_.body_from_camera));
  if (!has_whole_target_in_picture(task)) {
    return refused("from there the target would not be wholly in the picture");
  }
  return steer(
      task, std::nullopt,
      fmt::format("goal {:.2f} m forward, {:.2f} right, {:.2f} down of the target, {:.1f} deg",
                  place.position_m.x(), place.position_m.y(), place.position_m.z(),
                  degrees(place.yaw_rad)));
}

Answer GroundDesk::hold_view() {
  if (views_.empty() || !views_.back()->seen) return refused("the target is not seen");
  Task task = task_;
  task.goal = *views_.back()->seen;
  return steer(task, std::nullopt,
               fmt::format("the view of frame {} is the goal", views_.back()->row.frame));
}

Answer GroundDesk::freeze(std::int64_t frame) {
  const auto it = std::find_if(views_.begin(), views_.end(),
                               [&](const auto& view) { return view->row.frame == frame; });
  if (it == views_.end()) return refused("that picture is gone: freeze a newer one");
  frozen_ = *it;
  candidate_.reset();
  return done(fmt::format("frame {} is frozen", frame));
}

/// The width of what is in the rectangle, were it where the target is; without the target in sight,
/// were it as large in the picture as the goal wants the target.
double GroundDesk::likely_width_m(const PixelBox& box, const GroundView& view) const {
  const TargetPose& pose = view.seen ? *view.seen : task_.goal;
  const double width_px = straight_place(box, task_.camera).H(0, 0) * box.width;
  return width_px * pose.translation.z() / task_.camera.parameters().px;
}

Reply GroundDesk::examine(const PixelBox& box, Lock& lock) {
  const auto view = frozen_;
  const TrackOptions options = task_.track;
  const Camera camera = task_.camera;
  if (!view) return {refused("freeze a picture first"), {}, {}, {}};
  lock.unlock();  // learning takes a while, and abort must not wait for it
  std::optional<Tracker> tracker;
  Reply reply;
  try {
    tracker.emplace(straight_template(view->gray, box, camera), box, options);
    reply.verdict = template_verdict(tracker->model(), options);
    reply.answer = done(reply.verdict->words);
  } catch (const std::invalid_argument& error) {
    reply.answer = refused(error.what());
  }
  lock.lock();
  if (frozen_ != view) return {refused("another picture was frozen meanwhile"), {}, {}, {}};
  candidate_.reset();
  if (!tracker) return reply;
  reply.width_m = likely_width_m(box, *view);
  candidate_.emplace(Candidate{std::move(*tracker), box, view});
  return reply;
}

Answer GroundDesk::use(double width_m) {
  if (!candidate_) return refused("draw a template first");
  const PixelBox& box = candidate_->box;
  Task task = task_;
  task.target_width_m = width_m;
  const Homography place = straight_place(box, task.camera);
  const double sides = place.H(1, 1) * box.height / (place.H(0, 0) * box.width);
  task.target_height_m = width_m * sides;  // as if seen from the front
  const PlaneSize size{box.width, box.height, task.target_width_m, task.target_height_m};
  const auto pose = plane_pose(place, size, without_lens(task.camera), std::nullopt, task.pose);
  if (!pose) return refused("from that place no goal follows; draw another rectangle");
  task.goal =
      levelled(pose->camera_from_target, candidate_->view->row.attitude, task.body_from_camera);
  Answer answer = steer(
      task, std::move(candidate_->tracker),
      fmt::format("new template {:.0f}x{:.0f} px, {:.3g} m wide", box.width, box.height, width_m));
  candidate_.reset();
  if (answer.kind == Answer::Kind::Done) stop_or_start(Ask::Hover);  // doubt means hover
  return answer;
}

}  // namespace kestrel

#include "kestrel/loop/step.hpp"

#include "kestrel/geometry/straight_view.hpp"

namespace kestrel {
namespace {

PlaneSize plane_size(const Template& model, const Task& task) {
  return {model.width(), model.height(), task.target_width_m, task.target_height_m};
}

std::vector<Feature> corners_of(const StraightView& view, const Template& model,
                                const TargetPose& camera_from_target, const Task& task) {
  const double left = -0.5;  // the outer edge of the first pixel, whose centre is at 0
  const double right = model.width() - 0.5;
  const double bottom = model.height() - 0.5;
  const std::array<Pixel, 4> edges = {
      {{left, left}, {right, left}, {right, bottom}, {left, bottom}}};
  const std::array<Eigen::Vector3d, 4> in_target = target_corners(task);
  std::vector<Feature> corners;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const ImagePoint at = view.camera.to_image_point(view.image_from_template * edges[i]);
    corners.push_back({at, (camera_from_target * in_target[i]).z()});
  }
  return corners;
}

}  // namespace

std::vector<Feature> corner_features(const Homography& image_from_template, const Template& model,
                                     const TargetPose& camera_from_target, const Task& task) {
  const auto view = straight_view(image_from_template, model.width(), model.height(), task.camera);
  return view ? corners_of(*view, model, camera_from_target, task) : std::vector<Feature>{};
}

LoopState start(const Tracker& tracker, const Frame& first) {
  LoopState state;
  state.track = tracker.start(first.gray.cols, first.gray.rows);
  return state;
}

Step step(Tracker& tracker, const Frame& frame, const LoopState& state, const Task& task,
          const std::optional<Eigen::Vector3d>& velocity_ned_m_s) {
  const Template& model = tracker.model();
  Step s;
  s.track = tracker.track(frame, state.track);
  const auto view = straight_view(s.track, model.width(), model.height(), task.camera);
  if (view) {
    s.pose = plane_pose(view->image_from_template, plane_size(model, task), view->camera,
                        state.pose, task.pose);
  }
  if (s.pose) s.measured = corners_of(*view, model, s.pose->camera_from_target, task);
  s.decision =
      decide(s.measured, frame.attitude, frame.stamp_s, state.decision, task, velocity_ned_m_s);
  s.next.track = s.track.next;
  s.next.pose = s.pose ? s.pose->camera_from_target : state.pose;
  s.next.decision = s.decision.next;
  return s;
}

}  // namespace kestrel

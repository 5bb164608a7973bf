#pragma once

#include <optional>
#include <vector>

#include "kestrel/geometry/plane_pose.hpp"
#include "kestrel/loop/decide.hpp"
#include "kestrel/loop/task.hpp"
#include "kestrel/vision/frame.hpp"
#include "kestrel/vision/template.hpp"
#include "kestrel/vision/track.hpp"
#include "kestrel/vision/tracker.hpp"

namespace kestrel {

/// The state between two frames.
struct LoopState {
  TrackState track;
  std::optional<TargetPose> pose;  // of the last frame that had one
  DecisionState decision;
};

/// One frame's way through the chain, all of it.
struct Step {
  Track track;
  std::optional<PlanePose> pose;
  std::vector<Feature> measured;  // four corners; empty when not seen
  Decision decision;
  LoopState next;
};

/// The features of the target's corners in the tilted camera: the image of the edges of the
/// template (half a pixel outside the centres of its corner pixels), the lens removed
/// (straight_view), with the depths of the pose. In the order of desired_features; empty where the
/// lens shows too little of the template.
std::vector<Feature> corner_features(const Homography& image_from_template, const Template& model,
                                     const TargetPose& camera_from_target, const Task& task);

/// State before the first frame.
LoopState start(const Tracker& tracker, const Frame& first);

/// track -> pose -> features -> decide: the body of the paper's figure 2. The tracker lends its
/// memory; its options are those it was made with. velocity_ned_m_s: the vehicle's when the frame
/// was captured, where somebody measured it.
Step step(Tracker& tracker, const Frame& frame, const LoopState& state, const Task& task,
          const std::optional<Eigen::Vector3d>& velocity_ned_m_s = std::nullopt);

}  // namespace kestrel

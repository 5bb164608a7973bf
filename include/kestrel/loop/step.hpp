#pragma once

#include <optional>
#include <vector>

#include "kestrel/loop/task.hpp"
#include "kestrel/vehicle/velocity_command.hpp"
#include "kestrel/vision/frame.hpp"
#include "kestrel/vision/template.hpp"
#include "kestrel/vision/track.hpp"

namespace kestrel {

/// What the decision carries from frame to frame.
struct DecisionState {
  VelocityCommand sent;                // the previous command, after limits
  std::optional<double> stamp_s;       // of the previous frame
  VelocityCommand servo_command;       // the last one decided with the target in view, after limits
  std::optional<double> seen_stamp_s;  // of the last frame with the target in view
};

/// From features to a command.
struct Decision {
  std::optional<Servo> servo;  // when the target was seen and the law has an answer
  BodyTwist body_twist;        // body_from_camera * servo->twist; zero without servo
  VelocityCommand wanted;      // before the limits
  VelocityCommand command;     // what is sent: finite, within the limits
  CommandState state = CommandState::Hover;
  DecisionState next;
};

/// The part of the loop below the image: features of the target's corners as the camera measured
/// them (empty: not seen), levelled when the attitude is known -> servo law -> body -> limits;
/// hold, decay, hover without features. stamp_s: capture time of the frame. Never throws for what a
/// frame may bring; a stamp that does not increase or is not finite means hover.
Decision decide(const std::vector<Feature>& measured, const std::optional<Attitude>& attitude,
                double stamp_s, const DecisionState& state, const Task& task);

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

/// State before the first frame.
LoopState start(const Template& model, const Frame& first, const Task& task);

/// track -> pose -> features -> decide: the body of the paper's figure 2.
Step step(const Template& model, const Frame& frame, const LoopState& state, const Task& task);

}  // namespace kestrel

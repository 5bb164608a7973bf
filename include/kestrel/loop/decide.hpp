#pragma once

#include <optional>
#include <vector>

#include "kestrel/geometry/attitude.hpp"
#include "kestrel/loop/task.hpp"
#include "kestrel/loop/timing.hpp"
#include "kestrel/servo/servo.hpp"
#include "kestrel/vehicle/failsafe.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// What the decision carries from frame to frame.
struct DecisionState {
  VelocityCommand sent;                 // the previous command, after limits
  std::optional<double> stamp_s;        // of the previous frame
  VelocityCommand servo_command;        // the last one the law decided, after limits
  std::optional<double> seen_stamp_s;   // of the frame it was decided for
  LawState law{};                       // what the law has learned, and how it began
  std::optional<double> law_since_s{};  // stamp of its first answer after hover
  LoopTiming timing{};     // the period by the stamps; the latency is told by who sends the command
  DeadReckoning motion{};  // of the vehicle, by the commands, each obeyed after the latency
};

/// From features to a command.
struct Decision {
  std::optional<Servo> servo;             // when the target was seen and the law has an answer
  LawRefusal refusal = LawRefusal::None;  // why not, when the target was seen
  BodyTwist body_twist;     // of the body (levelled when the attitude is known); zero without
  VelocityCommand wanted;   // before the limits
  VelocityCommand command;  // what is sent: finite, within the limits
  CommandState state = CommandState::Hover;
  DecisionState next;
  double predicted_s = 0;              // latency over which the features were predicted
  std::optional<double> gain_per_s{};  // the law's, when the timing allows no more
};

/// The part of the loop below the image: features of the target's corners (as desired_features
/// orders them) as the camera measured them, empty when not seen -> servo law -> body -> limits;
/// hold, decay, hover without features or answer. stamp_s: capture time of the frame; attitude and
/// velocity: the vehicle's then, as far as they are known.
///
/// With an attitude the features are turned into the levelled camera and the lever arm into the
/// levelled body, so that the law is exact in the heading frame the command is for. Without one the
/// camera is taken as it is, and the tilt of the helicopter is answered as if it were an error.
///
/// The laws that want a pose or a homography get those of the levelled target, and the laws that
/// learn are told that the camera moved from frame to frame as the last command said: what is known
/// of it without a second sensor.
///
/// Where the latency is known, the gain is at most largest_gain_per_s(), and the features are
/// predicted over it (task.timing, see predicted()): to where the levelled camera will be when the
/// command is obeyed, by the velocity measured and the commands under way. A prediction that puts a
/// point behind the camera is not used.
///
/// The change of the command is limited over the time since the previous frame. The first frame has
/// none, and after a gap longer than loss.hover_after_s nothing is known of what the helicopter
/// did: both start from hover and change nothing yet.
///
/// Never throws for what a frame may bring. Hover, with all before it forgotten, when the stamp is
/// not finite or does not increase, and when a feature or the attitude is not finite.
Decision decide(const std::vector<Feature>& measured, const std::optional<Attitude>& attitude,
                double stamp_s, const DecisionState& state, const Task& task,
                const std::optional<Eigen::Vector3d>& velocity_ned_m_s = std::nullopt);

}  // namespace kestrel

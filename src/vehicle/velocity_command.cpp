#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

bool is_finite(const VelocityCommand& command) { return command.vector().allFinite(); }

VelocityCommand to_command(const BodyTwist& twist) {
  if (!twist.vector().allFinite()) return VelocityCommand::hover();
  return {twist.linear.x(), twist.linear.y(), twist.linear.z(), twist.angular.z()};
}

}  // namespace kestrel

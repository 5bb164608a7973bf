#pragma once

#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// Largest velocities and largest changes of them.
struct CommandLimits {
  VelocityCommand speed{2.0, 1.5, 1.0, 0.5235987755982988};         // m/s, m/s, m/s, rad/s
  VelocityCommand acceleration{2.0, 2.0, 1.5, 1.0471975511965976};  // the same per s

  /// Throws std::invalid_argument that names the first limit that is not positive and finite.
  void check() const;
};

/// The command scaled by one common factor so that no component exceeds its limit: the direction,
/// hence the path in the image, is kept (the rule of vpRobot::saturateVelocities). Hover for a
/// command or a limit that is not finite.
VelocityCommand saturated(const VelocityCommand& command, const VelocityCommand& limit);

/// The point nearest to `wanted` on the segment from `previous` to it that no acceleration limit
/// forbids within duration_s; `previous` for a duration that is not positive. Hover when anything
/// is not finite: the step to hover is never forbidden.
VelocityCommand slewed(const VelocityCommand& previous, const VelocityCommand& wanted,
                       const VelocityCommand& acceleration, double duration_s);

/// Saturated, then slewed: what may be sent. Hover when anything is not finite.
VelocityCommand limited(const VelocityCommand& previous, const VelocityCommand& wanted,
                        const CommandLimits& limits, double duration_s);

}  // namespace kestrel

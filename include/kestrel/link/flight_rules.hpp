#pragma once

#include <optional>

#include "kestrel/link/frame.hpp"
#include "kestrel/link/peer_counters.hpp"
#include "kestrel/link/switch_options.hpp"
#include "kestrel/link/switch_status.hpp"

namespace kestrel {

/// The standing of one who sends something to flight control.
struct FlightSender {
  LinkRole role = LinkRole::Telemetry;
  LinkPermissions may;
  ControlState control = ControlState::Idle;
  bool has_control = false;  // owns control, or nobody does and it is free
};

/// Why a message other than a setpoint may not go to flight control; empty when it may. Whatever is
/// not in this table may not:
///
///     message                               ground      vision               script
///     HEARTBEAT, PING, TIMESYNC             yes         yes                  yes
///     REQUEST_DATA_STREAM                   yes         yes                  no
///     SYSTEM_TIME, COMMAND_ACK              yes         no                   no
///     SET_MODE, PARAM_SET                   yes         no                   no
///     MANUAL_CONTROL                        (manual)    no                   no
///     COMMAND_LONG/INT interval, request    yes         yes                  yes
///                      mode, land, return   yes         in control           in control
///                      arm, take off        yes         (arm), in control    (arm), in control
///                      any other            yes         no                   no
///     LANDING_TARGET, VISION_*, ODOMETRY    no          (estimator)          no
///
/// (manual), (arm), (estimator): with that permission of the link. Under the emergency stop nobody
/// arms, takes off, starts a mission or moves sticks, and companions command nothing that moves.
/// Every float must be finite, also where NaN would mean "not used": so PX4's negative integer
/// parameters, whose bits are NaN as floats, cannot be set through the switch.
std::optional<Refused> refused_for_flight(const mavlink::FrameView& frame,
                                          const FlightSender& sender);

/// True when no float of the payload is NaN or infinite.
bool is_finite(const mavlink::FrameView& frame);

}  // namespace kestrel

#pragma once

#include <cstdint>
#include <optional>

#include "kestrel/link/arbiter.hpp"
#include "kestrel/link/command_guard.hpp"
#include "kestrel/link/flight_stream.hpp"

namespace kestrel {

/// Control messages: COMMAND_LONG from a ground link to the switch's own system and component,
/// answered by COMMAND_ACK with the ControlWord in result_param2. MAV_CMD_USER_1 to MAV_CMD_USER_5
/// of MAVLink.
enum class SwitchControl : std::uint16_t {
  TakeOver = 31010,       // only ground sources may have control from now on
  Lock = 31011,           // the present owner keeps control
  Release = 31012,        // ends both; zero, then who speaks next may have control
  EmergencyStop = 31013,  // zeros, whatever anybody says
  Reset = 31014,          // ends the emergency stop; zero, then who speaks next
};

/// True for the numbers of SwitchControl.
bool is_switch_control(std::uint16_t command);

struct CommandDeskOptions {
  CommandLimits envelope;
  double period_s = 0.05;
  double deadman_s = 0.5;
  double time_to_live_s = 0.5;
  double dead_after_s = 5;
};

/// From the setpoints of many sources to the one stream for flight control: guarded, arbitrated,
/// limited. Whenever control goes from one to another, or ends, a zero goes out at once and the
/// setpoint that claimed it is not obeyed.
class CommandDesk {
 public:
  explicit CommandDesk(const CommandDeskOptions& options);

  /// Empty when it is obeyed, or gives its source control.
  std::optional<Refused> setpoint(const Claimant& from, const mavlink::SetPositionTarget& setpoint,
                                  Arrival arrival, double now_s);

  void heartbeat(const Claimant& from, double now_s) { arbiter_.heartbeat(from, now_s); }

  /// False when it cannot be done: a lock without an owner.
  bool control(SwitchControl what);

  void forget(PeerId peer, double now_s);

  /// Flight control has just been reached: whatever is wanted, it starts from rest.
  void start_from_rest(double now_s) { stream_.start_from_rest(now_s); }

  /// Stops for good.
  void close();

  /// The setpoint that must go to flight control now, and then counts as sent; empty when none
  /// must. To be asked after all of the above, and at least once a period.
  std::optional<FlightSetpoint> due(double now_s);

  const Arbiter& arbiter() const { return arbiter_; }
  const FlightStream& stream() const { return stream_; }
  /// Sources newly dead, see Arbiter.
  std::vector<SourceId> take_dead() { return arbiter_.take_dead(); }
  /// How often an owner's last setpoint outlived its time.
  std::uint64_t deadman_count() const { return deadman_count_; }

 private:
  void settle(double now_s);
  void look_who_owns();
  void send_zero();

  CommandDeskOptions options_;
  CommandGuard guard_;
  Arbiter arbiter_;
  FlightStream stream_;
  std::optional<SourceId> owner_;        // at the last look
  std::optional<double> fresh_until_s_;  // of the setpoint being followed
  bool must_send_ = false, owes_zero_ = false, closed_ = false;
  std::uint64_t deadman_count_ = 0;
};

}  // namespace kestrel

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/link/autopilot_profile.hpp"
#include "kestrel/link/command_request.hpp"
#include "kestrel/link/telemetry.hpp"

namespace kestrel {

/// Where we stand with the autopilot.
enum class HandshakeState {
  Unseen,      // no autopilot is heard, or no longer
  Seen,        // heard; nothing is asked of it
  Asking,      // for its mode, its arming, a take-off
  Climbing,    // it takes off
  InControl,   // it obeys our setpoints
  Landing,     // at our request
  GivingBack,  // the mode is to be left
  Released,    // given back, landed, or taken over by a pilot: only a new request begins again
  Refused,     // it cannot be: words() say why; only a new request begins again
};

/// "unseen", "seen", "asking", "climbing", "in control", "landing", "giving back", "released",
/// "refused".
const char* name(HandshakeState state);

/// What may be streamed to the autopilot.
enum class StreamWish { Silence, Zeros, Commands };

struct HandshakeOptions {
  bool take_control = true;   // false: nothing is ever asked, the pilot chooses the mode
  bool allow_arming = false;  // without it no arming, no take-off, no landing is ever asked for
  double takeoff_m = 0;       // height to take off to when it stands; 0: it must be in the air
  double confirm_s = 3;       // so long what was accepted may take to be reported
  double climb_s = 60;        // so long a take-off may last
  double lost_s = 5;          // without a heartbeat for so long the autopilot is gone
  RequestOptions request;

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// Who has control, step by step; sends nothing itself and reads no clock. Whoever else changes the
/// mode while we ask or have control takes it over: from then on nothing is sent and nothing asked
/// for until a human asks again.
class Handshake {
 public:
  /// Throws as HandshakeOptions::check.
  explicit Handshake(const HandshakeOptions& options = {});

  /// A human wants us to fly. Asks for what is missing as soon as the autopilot is heard; changes
  /// nothing while it is being asked for, or held. Without take_control it is refused.
  void request_control();

  /// A human wants it down: with allow_arming and in control only, else it changes nothing and
  /// words() say why.
  void request_landing();

  /// Control is given back: PX4 is asked to hold its place, ArduPilot keeps its mode, in which it
  /// does so by itself once zeros were the last it heard. Whatever is being asked for is dropped.
  void release();

  /// An acknowledgement of the autopilot for us.
  void acknowledge(const mavlink::CommandAck& answer, double now_s);

  /// Looks at the vehicle and moves on: the command to be sent now, if any.
  std::optional<mavlink::CommandLong> tick(const std::optional<VehicleState>& vehicle,
                                           const Recipient& to, double now_s);

  HandshakeState state() const { return state_; }
  StreamWish wish() const;

  /// The rules of the autopilot; empty before one that is known was heard.
  const std::optional<AutopilotProfile>& profile() const { return profile_; }

  /// Why it stands where it stands: one sentence, for a human.
  const std::string& words() const { return words_; }

 private:
  enum class Goal { None, Control, Landing, GiveBack };
  enum class Step { Stream, Mode, Arm, TakeOff, Hold, Land };
  using Command = std::optional<mavlink::CommandLong>;

  bool is_there(const std::optional<VehicleState>& vehicle, double now_s);
  void watch(const VehicleState& vehicle);
  Command pursue(const VehicleState& vehicle, const Recipient& to, double now_s);
  Command pursue_control(const VehicleState& vehicle, const Recipient& to, double now_s);
  Command pursue_takeoff(const VehicleState& vehicle, const Recipient& to, double now_s);
  Command climb(const VehicleState& vehicle, double now_s);
  Command mode(const VehicleState& vehicle, const Recipient& to, double now_s);
  Command ask(Step step, const mavlink::CommandLong& command, double now_s);
  bool may_take_off(const VehicleState& vehicle);
  bool is_up(const VehicleState& vehicle) const;
  void end(HandshakeState state, const std::string& words);

  HandshakeOptions options_;
  HandshakeState state_ = HandshakeState::Unseen;
  std::string words_ = "no autopilot has been heard";
  std::optional<AutopilotProfile> profile_;
  Goal goal_ = Goal::None;
  std::optional<std::uint32_t> mode_before_;  // when we began to ask
  std::optional<Step> step_;
  std::optional<CommandRequest> request_;
  double step_began_s_ = 0;
  bool takes_off_ = false;               // it stood when we began to ask
  std::optional<double> climb_began_s_;  // the take-off was accepted
  double ground_m_ = 0;                  // down_m where it stood
};

}  // namespace kestrel

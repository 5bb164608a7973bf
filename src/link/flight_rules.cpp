#include "kestrel/link/flight_rules.hpp"

#include <algorithm>
#include <array>
#include <variant>

#include "kestrel/link/message.hpp"

namespace kestrel {
namespace {

using Verdict = std::optional<Refused>;

// MAV_CMD
constexpr std::uint16_t kLand = 21, kTakeOff = 22, kReturn = 20, kTakeOffLocal = 24,
                        kTakeOffVtol = 84, kSetMode = 176, kMissionStart = 300, kArm = 400,
                        kMessageInterval = 511, kRequestMessage = 512;

template <std::size_t N>
bool is_among(std::uint16_t command, const std::array<std::uint16_t, N>& list) {
  return std::find(list.begin(), list.end(), command) != list.end();
}

/// What makes a vehicle at rest move.
bool sets_off(std::uint16_t command, float param1) {
  constexpr std::array<std::uint16_t, 4> kStarts = {kTakeOff, kTakeOffLocal, kTakeOffVtol,
                                                    kMissionStart};
  return is_among(command, kStarts) || (command == kArm && param1 != 0);
}

Verdict allowed_if(bool allowed) {
  return allowed ? std::nullopt : std::optional(Refused::NotAllowed);
}

Verdict companion_command(std::uint16_t command, const FlightSender& sender) {
  constexpr std::array<std::uint16_t, 2> kAsking = {kMessageInterval, kRequestMessage};
  constexpr std::array<std::uint16_t, 3> kSteering = {kSetMode, kLand, kReturn};
  constexpr std::array<std::uint16_t, 2> kStarting = {kArm, kTakeOff};
  if (is_among(command, kAsking)) return std::nullopt;
  const bool starts = is_among(command, kStarting);
  if (!starts && !is_among(command, kSteering)) return Refused::NotAllowed;
  if (starts && !sender.may.arm) return Refused::NotAllowed;
  if (sender.control == ControlState::Stopped) return Refused::Stopped;
  return sender.has_control ? std::nullopt : std::optional(Refused::NotOwner);
}

Verdict any_command(std::uint16_t command, float param1, const FlightSender& sender) {
  switch (sender.role) {
    case LinkRole::Ground:
      if (sender.control == ControlState::Stopped && sets_off(command, param1)) {
        return Refused::Stopped;
      }
      return std::nullopt;
    case LinkRole::Vision:
    case LinkRole::Script:
      return companion_command(command, sender);
    case LinkRole::Flight:
    case LinkRole::Telemetry:
      return Refused::NotAllowed;
  }
  return Refused::NotAllowed;
}

/// The table, one line for each message of it.
struct Rules {
  const FlightSender& sender;

  bool ground() const { return sender.role == LinkRole::Ground; }
  bool vision() const { return sender.role == LinkRole::Vision; }
  bool anyone() const { return ground() || vision() || sender.role == LinkRole::Script; }
  Verdict aid() const { return allowed_if(vision() && sender.may.aid_estimator); }

  template <class M>
  Verdict operator()(const M&) const {
    return Refused::NotAllowed;
  }
  Verdict operator()(const mavlink::Heartbeat&) const { return allowed_if(anyone()); }
  Verdict operator()(const mavlink::Ping&) const { return allowed_if(anyone()); }
  Verdict operator()(const mavlink::TimeSync&) const { return allowed_if(anyone()); }
  Verdict operator()(const mavlink::RequestDataStream&) const {
    return allowed_if(ground() || vision());
  }
  Verdict operator()(const mavlink::SystemTime&) const { return allowed_if(ground()); }
  Verdict operator()(const mavlink::CommandAck&) const { return allowed_if(ground()); }
  Verdict operator()(const mavlink::SetMode&) const { return allowed_if(ground()); }
  Verdict operator()(const mavlink::ParamSet&) const { return allowed_if(ground()); }
  Verdict operator()(const mavlink::ManualControl&) const {
    if (!ground() || !sender.may.manual_control) return Refused::NotAllowed;
    return sender.control == ControlState::Stopped ? std::optional(Refused::Stopped) : std::nullopt;
  }
  Verdict operator()(const mavlink::CommandLong& m) const {
    return any_command(m.command, m.param1, sender);
  }
  Verdict operator()(const mavlink::CommandInt& m) const {
    return any_command(m.command, m.param1, sender);
  }
  Verdict operator()(const mavlink::LandingTarget&) const { return aid(); }
  Verdict operator()(const mavlink::VisionPosition&) const { return aid(); }
  Verdict operator()(const mavlink::VisionSpeed&) const { return aid(); }
  Verdict operator()(const mavlink::Odometry&) const { return aid(); }
};

/// Finite by its bits: the exponent of a little-endian float is not all ones.
bool is_finite_float(Bytes payload, std::size_t offset) {
  const auto byte = [&](std::size_t i) { return i < payload.size ? payload.data[i] : 0; };
  return ((byte(offset + 3) & 0x7F) << 1 | byte(offset + 2) >> 7) != 0xFF;
}

}  // namespace

bool is_finite(const mavlink::FrameView& frame) {
  if (frame.info == nullptr) return false;
  for (const mavlink::FieldInfo& field : *frame.info) {
    if (field.type != mavlink::FieldType::Float) continue;
    for (std::size_t i = 0; i < field.size(); i += sizeof(float)) {
      if (!is_finite_float(frame.payload(), field.offset + i)) return false;
    }
  }
  return true;
}

std::optional<Refused> refused_for_flight(const mavlink::FrameView& frame,
                                          const FlightSender& sender) {
  const auto message = mavlink::message_of(frame.message_id(), frame.payload());
  if (!message || frame.info == nullptr) return Refused::NotAllowed;
  if (const Verdict verdict = std::visit(Rules{sender}, *message)) return verdict;
  return is_finite(frame) ? std::nullopt : std::optional(Refused::NotFinite);
}

}  // namespace kestrel

#include "kestrel/link/router.hpp"

#include <algorithm>

namespace kestrel {
namespace {

constexpr std::uint32_t kHeartbeat = 0, kSystemTime = 2, kPing = 4, kAttitude = 30,
                        kAttitudeQuaternion = 31, kLocalPosition = 32, kCommandAck = 77,
                        kTimeSync = 111, kExtendedSysState = 245, kSetupSigning = 256;

std::uint8_t byte_at(Bytes payload, const mavlink::FieldInfo* field) {
  const bool sent = field != nullptr && field->offset < payload.size;
  return sent ? payload.data[field->offset] : std::uint8_t{0};  // what is trimmed is zero
}

bool serves_a_companion(std::uint32_t message_id) {
  constexpr std::uint32_t kServing[] = {kHeartbeat,  kSystemTime,         kPing,
                                        kAttitude,   kAttitudeQuaternion, kLocalPosition,
                                        kCommandAck, kTimeSync,           kExtendedSysState};
  return std::find(std::begin(kServing), std::end(kServing), message_id) != std::end(kServing);
}

bool is(const Recipient& who, const mavlink::Envelope& envelope) {
  return who.system_id == envelope.system_id && who.component_id == envelope.component_id;
}

}  // namespace

FrameTarget target_of(const mavlink::FrameView& frame) {
  if (frame.info == nullptr) return {};
  const auto* system = frame.info->field("target_system");
  if (system == nullptr) system = frame.info->field("target");  // MANUAL_CONTROL
  const auto* component = frame.info->field("target_component");
  return {byte_at(frame.payload(), system), byte_at(frame.payload(), component), system != nullptr};
}

bool is_told(LinkRole role, const mavlink::FrameView& frame) {
  const std::uint32_t id = frame.message_id();
  if (id == kSetupSigning) return false;
  switch (role) {
    case LinkRole::Ground:
      return true;
    case LinkRole::Telemetry:
    case LinkRole::Flight:
      return frame.info != nullptr;
    case LinkRole::Vision:
    case LinkRole::Script:
      return serves_a_companion(id);
  }
  return false;
}

void Router::connect(PeerId peer, LinkRole role) {
  places_[peer] = Place{role, {}};
  destinations_.reserve(places_.size());
}

void Router::disconnect(PeerId peer) { places_.erase(peer); }

std::variant<Arrival, Refused> Router::learn(PeerId from, const mavlink::Envelope& envelope,
                                             double now_s) {
  const auto place = places_.find(from);
  if (place == places_.end()) return Refused::NoSource;
  if (const auto reason = refused(place->second.role, envelope, now_s)) return *reason;
  Heard& heard = slot(place->second, envelope);
  heard.last_s = now_s;
  return heard.sequence.arrive(envelope.sequence);
}

std::optional<Refused> Router::refused(LinkRole role, const mavlink::Envelope& envelope,
                                       double now_s) const {
  if (envelope.system_id == 0) return Refused::NoSource;
  if (is(options_.self, envelope)) return Refused::OwnIds;
  if (role != LinkRole::Flight && is(options_.vehicle, envelope)) return Refused::VehicleIds;
  for (const auto& [peer, place] : places_) {
    if (place.role == role) continue;
    for (const Heard& each : place.heard) {
      if (each.system_id == envelope.system_id && each.component_id == envelope.component_id &&
          now_s - each.last_s <= options_.live_s) {
        return Refused::IdsTaken;
      }
    }
  }
  return std::nullopt;
}

/// That of the ids, else a free one, else the one silent for longest.
Router::Heard& Router::slot(Place& place, const mavlink::Envelope& envelope) {
  Heard* oldest = place.heard.data();
  for (Heard& each : place.heard) {
    if (each.system_id == envelope.system_id && each.component_id == envelope.component_id) {
      return each;
    }
    const bool better = each.system_id == 0 || each.last_s < oldest->last_s;
    if (oldest->system_id != 0 && better) oldest = &each;
  }
  *oldest = Heard{envelope.system_id, envelope.component_id, 0, {}};
  return *oldest;
}

bool Router::is_behind(const Place& place, const FrameTarget& target, double now_s) const {
  if (target.system_id == 0) return true;
  if (place.role == LinkRole::Flight && target.system_id == options_.vehicle.system_id &&
      (target.component_id == 0 || target.component_id == options_.vehicle.component_id)) {
    return true;  // by the options, also before it was heard
  }
  return std::any_of(place.heard.begin(), place.heard.end(), [&](const Heard& each) {
    return each.system_id == target.system_id &&
           (target.component_id == 0 || each.component_id == target.component_id) &&
           now_s - each.last_s <= options_.expiry_s;
  });
}

const std::vector<PeerId>& Router::destinations(PeerId from, const mavlink::FrameView& frame,
                                                double now_s) {
  destinations_.clear();
  const FrameTarget target = target_of(frame);
  const bool for_me = target.system_id == options_.self.system_id &&
                      target.component_id == options_.self.component_id;
  const auto source = places_.find(from);
  if (for_me || source == places_.end()) return destinations_;
  for (const auto& [peer, place] : places_) {
    const bool loops =
        peer == from || (place.role == LinkRole::Flight && source->second.role == LinkRole::Flight);
    if (!loops && is_told(place.role, frame) && is_behind(place, target, now_s)) {
      destinations_.push_back(peer);
    }
  }
  return destinations_;
}

}  // namespace kestrel

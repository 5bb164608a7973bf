#include "fuzz/watched_switch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>

namespace kestrel::fuzz {
namespace {

void require(bool right, const char* what) {
  if (right) return;
  std::fprintf(stderr, "the switch was wrong: %s\n", what);
  std::abort();
}

SwitchLink link(const char* name, LinkRole role, Transport transport = Transport::Datagram) {
  SwitchLink made;
  made.name = name;
  made.role = role;
  made.transport = transport;
  return made;
}

constexpr double kRounding_s = 1e-9;  // of sums of times

bool is_zero(const VelocityCommand& c) {
  return c.forward_m_s == 0 && c.right_m_s == 0 && c.down_m_s == 0 && c.yaw_rate_rad_s == 0;
}

/// What a role may ever say to flight control, setpoints apart, by message id.
bool may_be_said(LinkRole role, std::uint32_t id) {
  static const std::set<std::uint32_t> kGroundIds = {0, 2, 4, 11, 23, 66, 75, 76, 77, 111};
  static const std::set<std::uint32_t> kVisionIds = {0, 4, 66, 75, 76, 111};
  static const std::set<std::uint32_t> kScriptIds = {0, 4, 75, 76, 111};
  if (role == LinkRole::Ground) return kGroundIds.count(id) > 0;
  if (role == LinkRole::Vision) return kVisionIds.count(id) > 0;
  return role == LinkRole::Script && kScriptIds.count(id) > 0;
}

bool has_only_finite_floats(const mavlink::FrameView& frame) {
  std::vector<std::uint8_t> payload(frame.payload().begin(), frame.payload().end());
  payload.resize(frame.info->longest);
  for (const mavlink::FieldInfo& field : *frame.info) {
    if (field.type != mavlink::FieldType::Float) continue;
    for (std::size_t at = field.offset; at < field.offset + field.size(); at += 4) {
      std::uint32_t bits = 0;
      for (std::size_t k = 0; k < 4; ++k) bits |= std::uint32_t(payload[at + k]) << (8 * k);
      if ((bits & 0x7F800000) == 0x7F800000) return false;
    }
  }
  return true;
}

}  // namespace

const mavlink::SigningKey& shared_key() {
  static const mavlink::SigningKey key({9, 8, 7, 6, 5, 4, 3, 2, 1});
  return key;
}

SwitchOptions watched_options() {
  SwitchOptions options;
  options.links = {link("flight", LinkRole::Flight), link("eye", LinkRole::Vision),
                   link("ground", LinkRole::Ground, Transport::Stream),
                   link("signed", LinkRole::Script), link("log", LinkRole::Telemetry)};
  options.links[kScript].key = shared_key();
  options.max_peers = 3;
  return options;
}

WatchedSwitch::WatchedSwitch() : core_(options_) {}

void WatchedSwitch::connect(PeerId peer, std::size_t link) {
  const bool first_flight = link == kFlight && !has_flight();
  core_.connect(peer, link, {"127.0.0.1", 1}, time());
  if (first_flight) {  // it is at rest, whatever was said before it came
    sent_ = {};
    sent_s_ = time_.now_s;
  }
  links_.clear();
  for (const PeerStatus& each : core_.status(time()).peers) links_[each.peer] = each.link;
}

bool WatchedSwitch::has_flight() const {
  return std::any_of(links_.begin(), links_.end(),
                     [](const auto& each) { return each.second == kFlight; });
}

void WatchedSwitch::disconnect(PeerId peer) {
  core_.disconnect(peer, time());
  links_.erase(peer);
}

void WatchedSwitch::receive(PeerId peer, Bytes bytes) {
  const bool may_command =
      links_.count(peer) > 0 && links_.at(peer) != kFlight && links_.at(peer) != kTelemetry;
  if (may_command) last_word_s_ = time_.now_s;
  look(core_.receive(peer, bytes, time()), peer);
}

void WatchedSwitch::tick() {
  look(core_.tick(time()), std::nullopt);
  // After each tick: if the last word is older than the deadman, flight control was told zero.
  const bool silent = time_.now_s - last_word_s_ >= options_.deadman_s + kRounding_s;
  if (silent) require(is_zero(core_.status(time()).sent), "no zero at the deadman");
}

void WatchedSwitch::shut_down() {
  look(core_.shutdown(time()), std::nullopt);
  shut_ = true;
  require(is_zero(core_.status(time()).sent), "no zero at the end");
}

void WatchedSwitch::look(const std::vector<Delivery>& deliveries, std::optional<PeerId> from) {
  const SwitchStatus status = core_.status(time());
  const bool handed_over = status.owner != owner_;
  owner_ = status.owner;
  zeros_ = 0;
  require(status.peers.size() <= kWatchedLinks * options_.max_peers, "too many peers");
  for (const PeerStatus& peer : status.peers) {
    const PeerCounters& c = peer.counters;
    require(c.frames == c.forwarded + c.kept + c.refused_frames(), "counters do not add up");
  }
  for (const Delivery& delivery : deliveries) {
    const auto parsed = mavlink::parse(delivery.bytes);
    const auto* frame = std::get_if<mavlink::FrameView>(&parsed.content);
    require(frame != nullptr && parsed.size == delivery.bytes.size, "not one whole frame");
    require(links_.count(delivery.to) > 0, "to nobody");
    const mavlink::Envelope envelope = frame->envelope();
    const bool own = envelope.system_id == 1 && envelope.component_id == 192;
    require(own || (from && delivery.to != *from), "back to the sender");
    require(frame->message_id() != 256, "a key was passed on");
    const std::size_t link = links_.at(delivery.to);
    if (options_.links[link].key) {
      require(mavlink::signature_matches(*frame, shared_key()), "not signed for a signed link");
    }
    if (own && frame->message_id() == 77) look_at_ack(*frame);
    if (link == kFlight) look_at_flight(*frame, from);
  }
  require(!handed_over || !has_flight() || zeros_ > 0, "no zero at the hand-over");
}

void WatchedSwitch::look_at_ack(const mavlink::FrameView& frame) {
  const auto ack = std::get<mavlink::CommandAck>(*mavlink::message_of(77, frame.payload()));
  if (ack.result != 0) return;
  if (ack.command == 31010) taken_over_ = true;
  if (ack.command == 31012) taken_over_ = false;
  if (ack.command == 31013) stopped_ = true;
  if (ack.command == 31014) stopped_ = false;
}

void WatchedSwitch::look_at_flight(const mavlink::FrameView& frame, std::optional<PeerId> from) {
  require(frame.info != nullptr, "an unknown message to flight control");
  require(has_only_finite_floats(frame), "a number that is not finite to flight control");
  const mavlink::Envelope envelope = frame.envelope();
  const bool own = envelope.system_id == 1 && envelope.component_id == 192;
  if (frame.message_id() == 84) {
    require(own, "somebody else's setpoint");
    look_at_setpoint(
        std::get<mavlink::SetPositionTarget>(*mavlink::message_of(84, frame.payload())));
    return;
  }
  if (own) {
    require(frame.message_id() == 0, "the switch says more than setpoints and heartbeats");
    return;
  }
  require(!shut_ && from && links_.count(*from) > 0, "said by nobody");
  const LinkRole role = options_.links[links_.at(*from)].role;
  require(may_be_said(role, frame.message_id()), "what this role may not say");
}

void WatchedSwitch::look_at_setpoint(const mavlink::SetPositionTarget& s) {
  require(s.type_mask == 0x5C7 && s.coordinate_frame == 8, "another frame or mask");
  require(s.target_system == 1 && s.target_component == 1, "for another vehicle");
  for (const float each : {s.vx_m_s, s.vy_m_s, s.vz_m_s, s.yaw_rate_rad_s}) {
    require(std::isfinite(each) && std::fpclassify(each) != FP_SUBNORMAL, "not a sound number");
  }
  const VelocityCommand now{s.vx_m_s, s.vy_m_s, s.vz_m_s, s.yaw_rate_rad_s};
  const Eigen::Vector4d v = now.vector(), limit = options_.envelope.speed.vector();
  require((v.cwiseAbs().array() <= limit.array()).all(), "over the envelope");
  const double span_s = std::min(time_.now_s - sent_s_, 2 / options_.rate_hz);
  const Eigen::Vector4d step =
      span_s * options_.envelope.acceleration.vector() + Eigen::Vector4d::Constant(1e-6);
  const Eigen::Vector4d change = (v - sent_.vector()).cwiseAbs();
  require(is_zero(now) || (change.array() <= step.array()).all(), "over the slew");
  if (stopped_ || shut_) require(is_zero(now), "a move after the stop");
  if (climbing_is_wrong_) require(now.down_m_s >= 0, "what nobody should obey was obeyed");
  require(is_zero(now) || time_.now_s - last_word_s_ < options_.deadman_s + kRounding_s,
          "a move from nowhere");
  zeros_ += is_zero(now) ? 1 : 0;
  sent_ = now;
  sent_s_ = time_.now_s;
}

}  // namespace kestrel::fuzz

#include "link/switch_bench.hpp"

#include <algorithm>
#include <stdexcept>

#include "kestrel/link/setpoint.hpp"

namespace kestrel::test {
namespace {

/// Who is behind a link of the bench.
mavlink::Envelope ids(PeerId peer) {
  switch (peer) {
    case SwitchBench::kFlight:
      return {1, 1, 0};
    case SwitchBench::kVision:
      return {1, 191, 0};
    case SwitchBench::kGround:
      return {255, 190, 0};
    case SwitchBench::kScript:
      return {1, 195, 0};
    default:
      return {7, 1, 0};
  }
}

SwitchLink link(const char* name, LinkRole role) {
  SwitchLink made;
  made.name = name;
  made.role = role;
  return made;
}

}  // namespace

SwitchOptions bench_switch() {
  SwitchOptions options;
  options.links = {link("autopilot", LinkRole::Flight), link("companion", LinkRole::Vision),
                   link("ground", LinkRole::Ground), link("script", LinkRole::Script),
                   link("listener", LinkRole::Telemetry)};
  return options;
}

SwitchBench::SwitchBench(const SwitchOptions& options)
    : core_(options), beating_{kFlight, kVision, kGround, kScript} {
  for (PeerId peer = kFlight; peer <= kListener; ++peer) connect(peer, peer - 1);
  pass(kStep_s);
}

std::optional<mavlink::Packet> SwitchBench::Heard::packet() const {
  const mavlink::Decoded decoded = mavlink::decode(view(bytes));
  const auto* packet = std::get_if<mavlink::Packet>(&decoded.content);
  if (packet == nullptr) return std::nullopt;
  return *packet;
}

Eigen::Vector4d SwitchBench::Flown::velocity() const {
  return {setpoint.vx_m_s, setpoint.vy_m_s, setpoint.vz_m_s, setpoint.yaw_rate_rad_s};
}

void SwitchBench::say(PeerId peer, Bytes bytes) { keep(core_.receive(peer, bytes, time())); }

Buffer SwitchBench::frame(PeerId peer, const mavlink::Message& message) {
  return copy(mavlink::encode(message, next_envelope(peer)).bytes());
}

mavlink::Envelope SwitchBench::next_envelope(PeerId peer) {
  mavlink::Envelope envelope = ids(peer);
  envelope.sequence = sequence_[peer]++;
  return envelope;
}

void SwitchBench::command(PeerId peer, const VelocityCommand& command, double age_s) {
  say(peer, mavlink::Message(velocity_setpoint(command, time_boot_ms(now_s_ - age_s), {})));
}

void SwitchBench::control(PeerId peer, SwitchControl what) {
  mavlink::CommandLong asked;
  asked.command = std::uint16_t(what);
  asked.target_system = SwitchOptions{}.self.system_id;
  asked.target_component = SwitchOptions{}.self.component_id;
  say(peer, mavlink::Message(asked));
}

void SwitchBench::pass(double duration_s) {
  const double end_s = now_s_ + duration_s;
  while (now_s_ < end_s - 1e-9) {
    now_s_ = std::min(now_s_ + kStep_s, end_s);
    if (now_s_ >= next_beat_s_) {
      for (const PeerId peer : beating_) say(peer, mavlink::Message(mavlink::Heartbeat{}));
      next_beat_s_ += 1;
    }
    keep(core_.tick(time()));
  }
}

void SwitchBench::fly(PeerId peer, const VelocityCommand& velocity, double duration_s) {
  const double end_s = now_s_ + duration_s;
  while (now_s_ < end_s - 1e-9) {
    command(peer, velocity);
    pass(0.05);
  }
}

void SwitchBench::disconnect(PeerId peer) {
  beating_.erase(peer);
  core_.disconnect(peer, time());
}

void SwitchBench::connect(PeerId peer, std::size_t link) {
  core_.connect(peer, link, {"127.0.0.1", std::uint16_t(5000 + peer)}, time());
}

std::vector<SwitchBench::Flown> SwitchBench::flown_since(double time_s) {
  std::vector<Flown> all;
  for (const Heard& heard : heard_[kFlight]) {
    const auto packet = heard.packet();
    if (!packet || heard.time_s < time_s) continue;
    if (const auto* s = std::get_if<mavlink::SetPositionTarget>(&packet->message)) {
      all.push_back({heard.time_s, *s});
    }
  }
  return all;
}

SwitchBench::Flown SwitchBench::last_flown() {
  const auto all = flown();
  if (all.empty()) throw std::logic_error("nothing was sent to flight control");
  return all.back();
}

std::uint64_t SwitchBench::refused(PeerId peer, Refused reason) const {
  return counters(peer).refused_as(reason);
}

PeerCounters SwitchBench::counters(PeerId peer) const {
  for (const PeerStatus& status : core_.status(time()).peers) {
    if (status.peer == peer) return status.counters;
  }
  throw std::logic_error("no such peer");
}

std::vector<SwitchEvent> SwitchBench::events(SwitchEventKind kind) {
  for (SwitchEvent& event : core_.take_events()) events_.push_back(std::move(event));
  std::vector<SwitchEvent> all;
  std::copy_if(events_.begin(), events_.end(), std::back_inserter(all),
               [kind](const SwitchEvent& event) { return event.kind == kind; });
  return all;
}

void SwitchBench::keep(const std::vector<Delivery>& deliveries) {
  for (const Delivery& d : deliveries) heard_[d.to].push_back({now_s_, copy(d.bytes)});
}

}  // namespace kestrel::test

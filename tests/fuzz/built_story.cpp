#include <algorithm>
#include <cmath>
#include <limits>

#include "kestrel/link/setpoint.hpp"

#include "fuzz/stories.hpp"

namespace kestrel::fuzz {
namespace {

/// One who speaks behind a peer: ids, sequence and clock.
struct Speaker {
  std::uint8_t sequence = 0;
  double clock_ahead_s = 0;
  double guarded_s = -1e9;  // when a fresh setpoint of it was last known to be sound
};

class BuiltStory {
 public:
  explicit BuiltStory(Bytes bytes) : choices_(bytes) {
    watched_.climbing_is_wrong();
    for (std::size_t link = 0; link < kWatchedLinks; ++link) come(link);
  }

  void tell() {
    while (choices_.are_left()) {
      go_on();
      watched_.pass(choices_.pick(8) == 0 ? 0.01 * choices_.byte() : 0.0002 * choices_.byte());
      if (choices_.pick(2) == 0) watched_.tick();
    }
    watched_.pass(1);
    watched_.tick();
    watched_.shut_down();
    say(pick_peer(), velocity_setpoint({1, 0, -1, 0}, 5, {}));
    watched_.tick();
  }

 private:
  using SpeakerId = std::pair<PeerId, unsigned>;

  void come(std::size_t link) { watched_.connect(++last_peer_, link); }

  void go_on() {
    switch (choices_.pick(16)) {
      case 0:
        return come(choices_.pick(kWatchedLinks));
      case 1:
        return leave();
      case 2:
        return say(pick_peer(), any_message());
      case 3:
        return control();
      case 4:
        return say(pick_peer(), mavlink::Heartbeat{});
      case 5:
        return step_clock();
      case 6:
        return climb_stale();
      case 7:
        return climb_unsound();
      case 8:
        return climb_unauthorised();
      default:
        return say_setpoint();
    }
  }

  void step_clock() {
    who_ = choices_.byte();
    Speaker& whose = speaker(pick_peer());
    whose.clock_ahead_s += 0.001 * double(std::int32_t(choices_.word()) >> choices_.pick(32));
    whose.guarded_s = -1e9;
  }

  PeerId pick_peer() { return 1 + choices_.pick(last_peer_ < 250 ? last_peer_ : 250); }
  std::size_t link_of(PeerId peer) const {
    const auto found = watched_.links().find(peer);
    return found == watched_.links().end() ? std::size_t(kWatchedLinks) : found->second;
  }
  Speaker& speaker(PeerId peer) { return speakers_[{peer, who_ % 2}]; }

  mavlink::Envelope envelope(PeerId peer, Speaker& from) {
    // Mostly the next number; sometimes any: late, double, after a gap.
    from.sequence = std::uint8_t(from.sequence + (choices_.pick(16) == 0 ? choices_.byte() : 1));
    const std::size_t link = link_of(peer);
    if (link == kFlight) return {1, 1, from.sequence};
    return {std::uint8_t(10 + link), std::uint8_t(1 + who_ % 2), from.sequence};
  }

  void send(PeerId peer, const mavlink::EncodedFrame& frame) {
    watched_.receive(peer, frame.bytes());
  }

  void say(PeerId peer, const mavlink::Message& message) {
    who_ = choices_.byte();
    const auto from = envelope(peer, speaker(peer));
    if (link_of(peer) != kScript) return send(peer, mavlink::encode(message, from));
    send(peer, mavlink::signed_frame(message, from, {1, sign_time()}, shared_key()));
  }

  std::uint64_t sign_time() {
    signed_ = std::max(signed_ + 1, mavlink::signing_time(watched_.unix_s()));
    return signed_;
  }

  void leave() {
    const PeerId peer = pick_peer();
    watched_.disconnect(peer);
  }

  /// Any message with any bytes, but for setpoints.
  mavlink::Message any_message() {
    const auto infos = mavlink::message_infos();
    const mavlink::MessageInfo& info = infos.begin()[choices_.pick(unsigned(infos.count))];
    const auto message = *mavlink::message_of(info.id, choices_.take(choices_.byte()));
    const bool setpoint = std::holds_alternative<mavlink::SetPositionTarget>(message);
    return setpoint ? mavlink::Message(mavlink::Heartbeat{}) : message;
  }

  void control() {
    mavlink::CommandLong command;
    command.command = std::uint16_t(31009 + choices_.pick(8));
    command.target_system = 1;
    command.target_component = 192;
    say(pick_peer(), command);
  }

  float level() { return float(std::pow(10.0, double(choices_.byte()) / 8 - 6)); }

  mavlink::SetPositionTarget setpoint(const Speaker& from, double captured_s, float down_m_s) {
    auto made = velocity_setpoint({}, time_boot_ms(captured_s + from.clock_ahead_s), {});
    made.vx_m_s = choices_.pick(2) == 0 ? level() : -level();
    made.vy_m_s = choices_.pick(2) == 0 ? level() : -level();
    made.yaw_rate_rad_s = choices_.pick(2) == 0 ? level() : -level();
    made.vz_m_s = down_m_s;
    return made;
  }

  std::uint64_t sound(PeerId peer) const {
    for (const PeerStatus& each : watched_.core().status(watched_.time()).peers) {
      if (each.peer != peer) continue;
      const PeerCounters& c = each.counters;
      return c.setpoints + c.refused_as(Refused::NotOwner) + c.refused_as(Refused::Locked) +
             c.refused_as(Refused::Stopped);
    }
    return 0;
  }

  /// A lawful one, by who may: it asks for no climb.
  void say_setpoint() {
    const PeerId peer = pick_peer();
    const std::size_t link = link_of(peer);
    if (link == kFlight || link >= kTelemetry) return;
    who_ = choices_.byte();
    const unsigned who = who_;
    const std::uint64_t before = sound(peer);
    Speaker& from = speaker(peer);
    const auto made = setpoint(from, watched_.now_s() - 0.0002 * choices_.byte(), 0);
    send_as(peer, who, made);
    if (sound(peer) != before) from.guarded_s = watched_.now_s();
  }

  void send_as(PeerId peer, unsigned who, const mavlink::Message& message) {
    who_ = who;
    const auto from = envelope(peer, speaker(peer));
    if (link_of(peer) != kScript) return send(peer, mavlink::encode(message, from));
    send(peer, mavlink::signed_frame(message, from, {1, sign_time()}, shared_key()));
  }

  /// From a source whose clock is known: captured longer ago than the time to live.
  void climb_stale() {
    const PeerId peer = pick_peer();
    who_ = choices_.byte();
    const unsigned who = who_;
    Speaker& from = speaker(peer);
    const bool known = watched_.now_s() - from.guarded_s < 1.5;  // forgotten after 2 s
    if (!known) return;
    // 51 ms: the shortest way known is no longer than that.
    const double age_s = 0.56 + 0.01 * choices_.byte();
    send_as(peer, who, setpoint(from, watched_.now_s() - age_s, -1));
  }

  /// Fresh, but with a number that is not sound, or another frame or mask.
  void climb_unsound() {
    using Limits = std::numeric_limits<float>;
    constexpr std::array<float, 4> kBad = {Limits::quiet_NaN(), Limits::infinity(),
                                           -Limits::infinity(), Limits::denorm_min()};
    using S = mavlink::SetPositionTarget;
    constexpr std::array<float S::*, 11> kFields = {
        &S::x_m,     &S::y_m,     &S::z_m,     &S::vx_m_s,  &S::vy_m_s,        &S::vz_m_s,
        &S::ax_m_s2, &S::ay_m_s2, &S::az_m_s2, &S::yaw_rad, &S::yaw_rate_rad_s};
    const PeerId peer = pick_peer();
    S made = setpoint(speaker(peer), watched_.now_s(), -1);
    const unsigned kind = choices_.pick(13);
    if (kind < kFields.size()) made.*kFields[kind] = kBad[choices_.pick(4)];
    if (kind == 11) made.type_mask = std::uint16_t(made.type_mask ^ (1 << choices_.pick(16)));
    if (kind == 12) made.coordinate_frame = std::uint8_t(9 + choices_.pick(200));
    say(peer, made);
  }

  /// Fresh and sound, but from one who may not: the vehicle, a listener, somebody behind a signed
  /// link without the key or with an old signature, ids that are not his, or while stopped or taken
  /// over.
  void climb_unauthorised() {
    const PeerId peer = pick_peer();
    const std::size_t link = link_of(peer);
    const auto made = setpoint(speaker(peer), watched_.now_s(), -1);
    if (link == kFlight || link == kTelemetry) return say(peer, made);
    const auto next = envelope(peer, speaker(peer));
    if (link == kScript) {
      if (choices_.pick(2) == 0) return send(peer, mavlink::encode(made, next));
      auto forged = mavlink::signed_frame(made, next, {1, sign_time()}, shared_key());
      forged.data[forged.size - 1 - choices_.pick(13)] ^= std::uint8_t(1 + choices_.pick(255));
      return send(peer, forged);
    }
    if (watched_.is_stopped() || (watched_.is_taken_over() && link == kVision)) {
      return say(peer, made);
    }
    const mavlink::Envelope wrong[] = {
        {0, 1, next.sequence}, {1, 1, next.sequence}, {1, 192, next.sequence}};
    send(peer, mavlink::encode(made, wrong[choices_.pick(3)]));
  }

  Choices choices_;
  WatchedSwitch watched_;
  std::map<SpeakerId, Speaker> speakers_;
  PeerId last_peer_ = 0;
  unsigned who_ = 0;
  std::uint64_t signed_ = 0;
};

}  // namespace

void tell_built_story(Bytes bytes) { BuiltStory(bytes).tell(); }

}  // namespace kestrel::fuzz

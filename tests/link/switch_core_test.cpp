#include "kestrel/link/switch_core.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "samples.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

using mavlink::Envelope;
using mavlink::FrameView;
using mavlink::Message;
using test::Buffer;

constexpr PeerId kFlight = 1, kEye = 2, kGround = 3, kScript = 4, kLogger = 5;
constexpr double kUnix_s = 1.7e9;
const mavlink::SigningKey kKey({1, 2, 3});

SwitchLink link(const char* named, LinkRole role, Transport transport = Transport::Datagram) {
  SwitchLink made;
  made.name = named;
  made.role = role;
  made.transport = transport;
  return made;
}

SwitchOptions usual() {
  SwitchOptions options;
  options.links = {link("fc", LinkRole::Flight), link("eye", LinkRole::Vision),
                   link("gcs", LinkRole::Ground, Transport::Stream), link("job", LinkRole::Script),
                   link("log", LinkRole::Telemetry)};
  return options;
}

/// What was told to one peer.
struct Told {
  std::vector<mavlink::Packet> packets;

  template <class M>
  std::vector<M> all() const {
    std::vector<M> found;
    for (const auto& each : packets) {
      if (const auto* message = std::get_if<M>(&each.message)) found.push_back(*message);
    }
    return found;
  }
  std::vector<mavlink::SetPositionTarget> setpoints() const {
    return all<mavlink::SetPositionTarget>();
  }
};

/// A switch with one peer on each link, and words for what they say.
class Desk {
 public:
  explicit Desk(const SwitchOptions& options = usual()) : core(options) {
    for (PeerId peer = kFlight; peer <= kLogger; ++peer) {
      core.connect(peer, peer - 1, {"127.0.0.1", std::uint16_t(peer)}, time());
    }
  }

  SwitchTime time() const { return {now_s, kUnix_s + now_s}; }
  Envelope ids(PeerId peer) {
    const std::uint8_t sequence = sequences[peer]++;
    if (peer == kFlight) return {1, 1, sequence};
    if (peer == kGround) return {255, 190, sequence};
    return {1, std::uint8_t(191 + 10 * (peer - kEye)), sequence};
  }
  void say(PeerId peer, const Message& message) {
    say_bytes(peer, test::copy(mavlink::encode(message, ids(peer)).bytes()));
  }
  void say_bytes(PeerId peer, const Buffer& bytes) {
    keep(core.receive(peer, test::view(bytes), time()));
  }
  void fly(PeerId peer, double forward_m_s) {
    say(peer, velocity_setpoint({forward_m_s, 0, 0, 0}, time_boot_ms(now_s), {}));
  }
  void command(PeerId peer, SwitchControl what) {
    mavlink::CommandLong message;
    message.command = std::uint16_t(what);
    message.target_system = 1;
    message.target_component = 192;
    say(peer, message);
  }
  void tick() { keep(core.tick(time())); }
  /// Heartbeats and setpoints of a source at 20 Hz, ticks between.
  void fly_for(PeerId peer, double forward_m_s, double duration_s) {
    for (const double end_s = now_s + duration_s; now_s < end_s; now_s += 0.025) {
      say(peer, mavlink::Heartbeat{});
      fly(peer, forward_m_s);
      now_s += 0.025;
      tick();
    }
  }
  void keep(const std::vector<Delivery>& deliveries) {
    for (const Delivery& each : deliveries) {
      const auto decoded = mavlink::decode(each.bytes);
      if (const auto* packet = std::get_if<mavlink::Packet>(&decoded.content)) {
        told[each.to].packets.push_back(*packet);
      } else {
        ++unknown[each.to];
      }
      last[each.to] = test::copy(each.bytes);
    }
  }
  PeerCounters counters(PeerId peer) const {
    for (const auto& each : core.status(time()).peers) {
      if (each.peer == peer) return each.counters;
    }
    return {};
  }
  double speed() const { return core.status(time()).sent.forward_m_s; }

  SwitchCore core;
  double now_s = 100;
  std::map<PeerId, std::uint8_t> sequences;
  std::map<PeerId, Told> told;
  std::map<PeerId, long> unknown;
  std::map<PeerId, Buffer> last;
};

TEST(SwitchCore, KnowsWhoIsConnectedAndHasRoomForSoMany) {
  SwitchOptions options = usual();
  options.max_peers = 1;
  Desk desk(options);
  desk.core.connect(9, 1, {"127.0.0.1", 5000}, desk.time());
  desk.core.disconnect(kGround, desk.time());
  EXPECT_EQ(desk.core.status(desk.time()).peers.size(), 4u);
  const auto events = desk.core.take_events();
  ASSERT_EQ(events.size(), 7u);
  EXPECT_EQ(events[5].kind, SwitchEventKind::TooManyPeers);
  EXPECT_EQ(events[6].kind, SwitchEventKind::Disconnected);
  desk.fly(9, 1);
  EXPECT_EQ(desk.core.status(desk.time()).unknown_peer_chunks, 1u);
}

TEST(SwitchCore, ForwardsAFreshSetpointInTheSameCallUnderItsOwnIds) {
  Desk desk;
  desk.fly(kEye, 0.5);
  desk.now_s += 0.02;
  desk.fly(kEye, 0.5);
  const Told& told = desk.told[kFlight];
  ASSERT_EQ(told.setpoints().size(), 2u);  // the zero of the claim, and the setpoint
  EXPECT_EQ(told.setpoints()[0].vx_m_s, 0);
  EXPECT_NEAR(told.setpoints()[1].vx_m_s, 0.04, 1e-6);
  EXPECT_EQ(told.packets[0].envelope.system_id, 1);
  EXPECT_EQ(told.packets[0].envelope.component_id, 192);
  EXPECT_EQ(told.packets[1].envelope.sequence, told.packets[0].envelope.sequence + 1);
  EXPECT_EQ(desk.counters(kEye).setpoints, 2u);
}

TEST(SwitchCore, BearsTheOwnersIdsOnRequest) {
  SwitchOptions options = usual();
  options.setpoint_ids = SetpointIds::Owner;
  Desk desk(options);
  desk.fly_for(kEye, 0.5, 0.2);
  EXPECT_EQ(desk.told[kFlight].packets.back().envelope.component_id, 191);
}

TEST(SwitchCore, StreamsAtItsRateAndZeroesTheSilentOwner) {
  Desk desk;
  desk.fly_for(kEye, 0.5, 1);
  EXPECT_NEAR(desk.speed(), 0.5, 1e-6);
  const double silent_s = desk.now_s - 0.05;
  double zero_s = 0;
  for (int i = 0; i < 40; ++i, desk.now_s += 0.05) {
    desk.tick();
    if (zero_s == 0 && desk.speed() == 0) zero_s = desk.now_s;
  }
  EXPECT_LE(zero_s - silent_s, 0.5 + 0.05 + 1e-9);
  const auto setpoints = desk.told[kFlight].setpoints();
  EXPECT_EQ(setpoints.back().vx_m_s, 0);
  EXPECT_GE(setpoints.size(), 55u);  // 3 s at 20 Hz, and no silence at the end
}

TEST(SwitchCore, RefusesAndNamesWhatMustNotPass) {
  Desk desk;
  desk.fly_for(kEye, 0.1, 0.2);
  auto bad = velocity_setpoint({1, 0, 0, 0}, time_boot_ms(desk.now_s), {});
  bad.yaw_rad = std::numeric_limits<float>::quiet_NaN();
  desk.say(kEye, bad);
  EXPECT_EQ(desk.counters(kEye).refused_as(Refused::NotFinite), 1u);
  desk.fly(kLogger, 1);
  EXPECT_EQ(desk.counters(kLogger).refused_as(Refused::NotAllowed), 1u);
  desk.fly(kFlight, 1);
  EXPECT_EQ(desk.counters(kFlight).refused_as(Refused::NotAllowed), 1u);
  desk.fly(kScript, 1);
  EXPECT_EQ(desk.counters(kScript).refused_as(Refused::NotOwner), 1u);
  desk.say(kEye, velocity_setpoint({1, 0, 0, 0}, time_boot_ms(desk.now_s), {7, 1}));
  EXPECT_EQ(desk.counters(kEye).refused_as(Refused::NotAllowed), 1u);
  desk.say(kEye, mavlink::SetAttitudeTarget{});
  EXPECT_EQ(desk.counters(kEye).refused_as(Refused::NotAllowed), 2u);
  desk.say(kGround, mavlink::SetupSigning{});
  EXPECT_EQ(desk.counters(kGround).refused_as(Refused::NotForwarded), 1u);
  for (const auto& each : desk.told[kFlight].setpoints()) {
    EXPECT_LE(each.vx_m_s, 0.1F);  // the owner's own, from before
  }
  const auto events = desk.core.take_events();
  EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const SwitchEvent& each) {
    return each.words.find("not finite") == 0;
  }));
}

TEST(SwitchCore, RoutesTelemetryAndCommands) {
  Desk desk;
  for (const PeerId peer : {kFlight, kEye, kGround, kScript}) desk.say(peer, mavlink::Heartbeat{});
  desk.say(kFlight, mavlink::AttitudeReport{});
  desk.say(kFlight, mavlink::StatusText{});
  EXPECT_EQ(desk.told[kEye].all<mavlink::AttitudeReport>().size(), 1u);
  EXPECT_EQ(desk.told[kEye].all<mavlink::StatusText>().size(), 0u);
  EXPECT_EQ(desk.told[kGround].all<mavlink::StatusText>().size(), 1u);
  EXPECT_EQ(desk.told[kLogger].all<mavlink::StatusText>().size(), 1u);
  mavlink::CommandLong arm;
  arm.command = 400;
  arm.param1 = 1;
  arm.target_system = arm.target_component = 1;
  desk.say(kGround, arm);
  EXPECT_EQ(desk.told[kFlight].all<mavlink::CommandLong>().size(), 1u);
  desk.say(kEye, arm);
  EXPECT_EQ(desk.told[kFlight].all<mavlink::CommandLong>().size(), 1u);
  EXPECT_EQ(desk.counters(kEye).refused_as(Refused::NotAllowed), 1u);
  desk.say_bytes(kEye, test::hand_made_frame(20000, {1, 2}, 3));
  EXPECT_EQ(desk.unknown[kGround], 1);
  EXPECT_EQ(desk.unknown[kEye] + desk.unknown[kScript] + desk.unknown[kLogger], 0);
}

TEST(SwitchCore, ObeysTheGroundsControlMessagesAndAnswers) {
  Desk desk;
  desk.fly_for(kEye, 0.5, 0.5);
  desk.command(kEye, SwitchControl::EmergencyStop);
  EXPECT_EQ(desk.told[kEye].all<mavlink::CommandAck>().back().result, 2);  // denied
  EXPECT_GT(desk.speed(), 0);
  desk.command(kGround, SwitchControl::EmergencyStop);
  EXPECT_EQ(desk.told[kGround].all<mavlink::CommandAck>().back().result, 0);
  EXPECT_EQ(desk.speed(), 0);
  desk.fly_for(kEye, 0.5, 0.5);
  EXPECT_EQ(desk.speed(), 0);
  desk.core.disconnect(kGround, desk.time());  // it survives who set it
  desk.fly_for(kEye, 0.5, 0.5);
  EXPECT_EQ(desk.speed(), 0);
  EXPECT_EQ(desk.core.status(desk.time()).control, ControlState::Stopped);
  desk.core.connect(9, 2, {"::1", 9}, desk.time());
  desk.sequences[9] = 77;
  desk.command(9, SwitchControl::Reset);
  desk.fly_for(kEye, 0.5, 0.5);
  EXPECT_NEAR(desk.speed(), 0.5, 1e-6);
}

TEST(SwitchCore, TellsWhoCommands) {
  Desk desk;
  desk.fly_for(kEye, 0.5, 2.5);
  const auto told = [&] {
    std::optional<ControlWord> word;
    for (const mavlink::Packet& packet : desk.told[kGround].packets) {
      const auto* beat = std::get_if<mavlink::Heartbeat>(&packet.message);
      const bool is_switchs = packet.envelope.component_id == 192;
      if (beat != nullptr && is_switchs) word = control_word(beat->custom_mode);
    }
    return word;
  };
  ASSERT_TRUE(told());
  EXPECT_EQ(told()->state, ControlState::Owned);
  EXPECT_EQ(told()->owner, LinkRole::Vision);
  desk.command(kGround, SwitchControl::TakeOver);
  const auto answer = control_word(
      std::uint32_t(desk.told[kGround].all<mavlink::CommandAck>().back().result_param2));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->state, ControlState::TakenOver);
  EXPECT_FALSE(answer->owner) << "nobody yet: a zero comes first";
}

TEST(SwitchCore, AnswersWhatItDoesNotKnow) {
  Desk desk;
  desk.command(kGround, SwitchControl(31015));
  EXPECT_EQ(desk.told[kGround].all<mavlink::CommandAck>().back().result, 3);  // unsupported
  desk.command(kGround, SwitchControl::Lock);
  EXPECT_EQ(desk.told[kGround].all<mavlink::CommandAck>().back().result, 2);  // to whom?
  EXPECT_TRUE(desk.told[kFlight].packets.empty());
}

SwitchOptions with_keys() {
  SwitchOptions options = usual();
  options.links[0].key = kKey;
  options.links[1].key = kKey;
  return options;
}

TEST(SwitchCore, RefusesUnsignedForgedAndRepeatedFramesWithoutAnyTrace) {
  Desk desk(with_keys());
  const auto setpoint = [&] {
    return velocity_setpoint({0.5, 0, 0, 0}, time_boot_ms(desk.now_s), {});
  };
  const std::uint64_t time = mavlink::signing_time(desk.time().unix_s);
  const auto good = mavlink::signed_frame(setpoint(), {1, 191, 0}, {1, time}, kKey);
  desk.say(kEye, setpoint());
  EXPECT_EQ(desk.counters(kEye).refused_as(Refused::Unsigned), 1u);
  for (std::size_t i = 0; i < good.size; ++i) {
    Buffer forged = test::copy(good.bytes());
    forged[i] ^= 0x10;
    desk.say_bytes(kEye, forged);
  }
  EXPECT_EQ(desk.counters(kEye).setpoints, 0u);
  // Each byte of the signature, and bytes that make it a message nobody knows.
  EXPECT_GE(desk.counters(kEye).refused_as(Refused::BadSignature), 13u);
  EXPECT_FALSE(desk.core.status(desk.time()).owner);
  EXPECT_TRUE(desk.told[kFlight].packets.empty());
  desk.say_bytes(kEye, test::copy(good.bytes()));
  EXPECT_EQ(desk.counters(kEye).setpoints, 1u);
  desk.say_bytes(kEye, test::copy(good.bytes()));
  EXPECT_EQ(desk.counters(kEye).refused_as(Refused::Replayed), 1u);
  const auto sent = std::get<FrameView>(mavlink::parse(test::view(desk.last[kFlight])).content);
  EXPECT_TRUE(mavlink::signature_matches(sent, kKey));
  EXPECT_EQ(desk.core.status(desk.time()).newest_signature, time);
}

TEST(SwitchCore, KeepsEachPeerToItsRate) {
  SwitchOptions options = usual();
  options.links[3].flow = {10, 5};
  Desk desk(options);
  for (int i = 0; i < 1000; ++i) desk.say(kScript, mavlink::Heartbeat{});
  EXPECT_EQ(desk.counters(kScript).frames, 5u);
  EXPECT_EQ(desk.counters(kScript).refused_as(Refused::TooFast), 995u);
  desk.fly_for(kEye, 0.5, 0.5);
  EXPECT_NEAR(desk.speed(), 0.5, 1e-6);
}

TEST(SwitchCore, ReadsStreamsCutAnywhere) {
  Desk desk;
  Buffer stream;
  for (int i = 0; i < 20; ++i) {
    const auto frame = mavlink::encode(mavlink::Heartbeat{}, desk.ids(kGround));
    const Buffer garbage(std::size_t(i), 0x55);
    stream = test::joined({stream, garbage, test::copy(frame.bytes())});
  }
  for (std::size_t i = 0; i < stream.size(); i += 7) {
    desk.say_bytes(kGround, test::copy(test::view(stream).after(i).first(7)));
  }
  EXPECT_EQ(desk.counters(kGround).frames, 20u);
  EXPECT_EQ(desk.told[kFlight].all<mavlink::Heartbeat>().size(), 20u);
}

TEST(SwitchCore, CountsASourceWithoutHeartbeatsAsDead) {
  Desk desk;
  for (const double end_s = desk.now_s + 5.5; desk.now_s < end_s; desk.now_s += 0.05) {
    desk.fly(kEye, 0.2);
    desk.tick();
  }
  EXPECT_EQ(desk.speed(), 0);
  EXPECT_GT(desk.counters(kEye).refused_as(Refused::Dead), 0u);
  const auto events = desk.core.take_events();
  EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const SwitchEvent& each) {
    return each.kind == SwitchEventKind::SourceDead;
  }));
}

TEST(SwitchCore, EndsWithZerosAndNothingElse) {
  Desk desk;
  desk.fly_for(kEye, 0.5, 0.5);
  desk.keep(desk.core.shutdown(desk.time()));
  EXPECT_EQ(desk.told[kFlight].setpoints().back().vx_m_s, 0);
  desk.told.clear();
  desk.command(kGround, SwitchControl::Reset);
  desk.fly_for(kEye, 0.5, 1.5);
  desk.say(kGround, mavlink::Heartbeat{});
  for (const auto& each : desk.told[kFlight].packets) {
    ASSERT_TRUE(std::holds_alternative<mavlink::SetPositionTarget>(each.message));
    EXPECT_EQ(std::get<mavlink::SetPositionTarget>(each.message).vx_m_s, 0);
  }
}

TEST(SwitchCore, HeartbeatsOnceAPeriodAndTellsItsState) {
  Desk desk;
  for (int i = 0; i < 100; ++i, desk.now_s += 0.05) desk.tick();
  EXPECT_EQ(desk.told[kGround].all<mavlink::Heartbeat>().size(), 5u);
  desk.command(kGround, SwitchControl::EmergencyStop);
  desk.now_s += 1;
  desk.tick();
  const auto last = desk.told[kLogger].all<mavlink::Heartbeat>().back();
  EXPECT_EQ(last.custom_mode, std::uint32_t(ControlState::Stopped));
  EXPECT_EQ(last.system_status, 6);  // MAV_STATE_EMERGENCY
}

}  // namespace
}  // namespace kestrel

// The fault table of the link, a test for each row, over the switch without its sockets. This half:
// what is wrong with the bytes or the numbers themselves.
#include "link/fault_table.hpp"

#include <cmath>

#include "kestrel/link/setpoint.hpp"

namespace kestrel::test {
namespace {

/// The float's bits: quiet, signalling and negative NaN, infinities, denormals.
constexpr std::uint32_t kBadFloats[] = {0x7FC00000, 0x7F800001, 0xFFC12345, 0x7F800000,
                                        0xFF800000, 0x00000001, 0x807FFFFF, 0x00400000};

Buffer with_float(const mavlink::Message& message, const mavlink::FieldInfo& field,
                  std::size_t element, std::uint32_t bits) {
  Buffer payload = fields(message);
  for (std::size_t k = 0; k < 4; ++k) {
    payload[field.offset + 4 * element + k] = std::uint8_t(bits >> (8 * k));
  }
  return payload;
}

/// A frame of the peer with this payload, its checksum right.
Buffer frame_of(const mavlink::MessageInfo& info, const Buffer& payload,
                const mavlink::Envelope& from) {
  Buffer frame = hand_made_frame(info.id, payload, info.crc_extra, 0, from.sequence);
  if (from.system_id == 1 && from.component_id == 191) return frame;
  const auto parsed = mavlink::parse(view(frame));
  const auto message =
      mavlink::message_of(info.id, std::get<mavlink::FrameView>(parsed.content).payload());
  return copy(mavlink::encode(*message, from).bytes());
}

mavlink::SetPositionTarget setpoint(const VelocityCommand& command, double now_s) {
  return velocity_setpoint(command, time_boot_ms(now_s), {});
}

/// One way in which a frame is damaged; never more than three bits, which the checksum always sees
/// (Koopman: CCITT-16 has Hamming distance 4 up to 32751 bits).
Buffer damaged(Buffer frame, Random& random) {
  switch (random.integer(0, 4)) {
    case 0:
      frame.resize(std::size_t(random.integer(1, int(frame.size()) - 1)));
      break;
    case 1:
      frame[0] = std::uint8_t(random.integer(0, 0xFC));
      break;  // false STX
    case 2:
      frame[1] = std::uint8_t(frame[1] + random.integer(1, 255));
      break;  // length lies
    case 3:
      frame.insert(frame.begin() + 10, 0xFD);
      break;  // STX within
    default:
      for (int flips = random.integer(1, 3); flips > 0; --flips) {
        const auto at = std::size_t(random.integer(1, int(frame.size()) - 1));
        frame[at] = std::uint8_t(frame[at] ^ (1u << random.integer(0, 7)));
      }
      // Two flips of one bit are none; then one more is.
      if (std::holds_alternative<mavlink::FrameView>(mavlink::parse(view(frame)).content)) {
        frame.back() = std::uint8_t(frame.back() ^ 1u);
      }
  }
  return frame;
}

TEST_F(FaultTable, DamagedFramesAreDroppedAndCountedPerPeerAndEveryIntactFrameStillPasses) {
  for (const Transport transport : {Transport::Datagram, Transport::Stream}) {
    SwitchOptions options = bench_switch();
    options.links[1].transport = transport;
    SwitchBench bench(options);
    bench.fly(kVision, good(), 0.5);
    Random random("fault table: damage");
    const std::uint64_t before = bench.counters(kVision).setpoints;
    const int kTries = 2000;
    for (int i = 0; i < kTries; ++i) {
      const Buffer intact = bench.frame(kVision, setpoint(bad(), bench.now_s()));
      const Buffer broken = damaged(intact, random);
      const Buffer next = bench.frame(kVision, setpoint(good(), bench.now_s() + 0.001));
      bench.say(kVision, joined({broken, next}));
      bench.pass(0.01);
    }
    try_bad(kTries);
    EXPECT_EQ(count_wrong(bench), 0);
    // A frame that lies about its length may hide in a datagram what follows it, no more.
    const std::uint64_t accepted = bench.counters(kVision).setpoints - before;
    EXPECT_EQ(accepted, std::uint64_t(kTries)) << int(transport);
    EXPECT_GE(bench.counters(kVision).refused_in_all(), std::uint64_t(kTries));
    EXPECT_EQ(bench.counters(kGround).refused_in_all(), 0u);
  }
}

TEST_F(FaultTable, AnUnknownMessageGoesToGroundStationsOnlyNeverToFlightControl) {
  const Buffer unknown = hand_made_frame(54321, {1, 2, 3, 4}, 77);
  for (const PeerId from : {kVision, kGround, kScript, kListener}) {
    for (std::uint8_t sequence = 100; sequence < 150; ++sequence) {
      Buffer frame = unknown;
      const mavlink::Envelope own = bench_.next_envelope(from);
      frame[4] = sequence;
      frame[5] = own.system_id;
      frame[6] = own.component_id;
      bench_.say(from, frame);
      try_bad();
    }
  }
  const auto count = [&](PeerId peer) {
    long unknowns = 0;
    for (const auto& heard : bench_.heard(peer)) unknowns += heard.packet() ? 0 : 1;
    return unknowns;
  };
  EXPECT_EQ(count(kFlight), 0);
  EXPECT_EQ(count_wrong(bench_), 0);
  EXPECT_EQ(count(kVision) + count(kScript) + count(kListener), 0);
  EXPECT_GE(count(kGround), 150);  // of all but itself
}

TEST_F(FaultTable, SourceSystemZeroAndOurOwnIdsFromOutsideAreRejected) {
  bench_.fly(kVision, good(), 0.5);
  const Recipient self = SwitchOptions{}.self;
  const Recipient vehicle = SwitchOptions{}.vehicle;
  const mavlink::Envelope liars[] = {{0, 191, 0},
                                     {0, 0, 0},
                                     {self.system_id, self.component_id, 0},
                                     {vehicle.system_id, vehicle.component_id, 0}};
  for (const PeerId from : {kVision, kGround, kScript, kListener}) {
    for (mavlink::Envelope liar : liars) {
      liar.sequence = std::uint8_t(from * 8);
      const auto frame = mavlink::encode(setpoint(bad(), bench_.now_s()), liar);
      bench_.say(from, frame.bytes());
      bench_.pass(0.05);
      try_bad();
    }
    EXPECT_EQ(bench_.refused(from, Refused::NoSource), 2u);
    EXPECT_EQ(bench_.refused(from, Refused::OwnIds), 1u);
    EXPECT_EQ(bench_.refused(from, Refused::VehicleIds), 1u);
  }
  EXPECT_EQ(count_wrong(bench_), 0);
}

TEST_F(FaultTable, NoNumberThatIsNotFiniteOrIsDenormalInAnyFloatOfASetpointPasses) {
  bench_.fly(kVision, good(), 0.5);
  const std::size_t accepted = bench_.counters(kVision).setpoints;
  std::uint64_t tries = 0;
  const mavlink::SetPositionTarget base = setpoint(good(), bench_.now_s());
  for (const mavlink::FieldInfo& field : mavlink::info_of(base)) {
    if (field.type != mavlink::FieldType::Float) continue;
    for (const std::uint32_t bits : kBadFloats) {
      const mavlink::Message fresh = setpoint(good(), bench_.now_s());
      const Buffer payload = with_float(fresh, field, 0, bits);
      bench_.say(kVision,
                 frame_of(mavlink::info_of(fresh), payload, bench_.next_envelope(kVision)));
      bench_.pass(0.01);
      ++tries;
    }
  }
  try_bad(long(tries));
  EXPECT_EQ(tries, 11 * std::size(kBadFloats));
  EXPECT_EQ(bench_.refused(kVision, Refused::NotFinite), tries);
  EXPECT_EQ(bench_.counters(kVision).setpoints, accepted);
  EXPECT_EQ(count_wrong(bench_), 0);
  EXPECT_FALSE(bench_.events(SwitchEventKind::Refused).empty());
  bool named = false;
  for (const SwitchEvent& event : bench_.events(SwitchEventKind::Refused)) {
    named = named || event.words.find(name(Refused::NotFinite)) != std::string::npos;
  }
  EXPECT_TRUE(named);
}

TEST_F(FaultTable, NoNumberThatIsNotFinitePassesInAnyOtherMessageEither) {
  Random random("fault table: floats");
  for (const PeerId from : {kVision, kGround, kScript}) {
    for (const mavlink::MessageInfo& info : mavlink::message_infos()) {
      for (const mavlink::FieldInfo& field : info) {
        if (field.type != mavlink::FieldType::Float) continue;
        for (const std::uint32_t bits : kBadFloats) {
          if ((bits & 0x7F800000) == 0) continue;  // denormals are numbers to others
          const auto element = std::size_t(random.integer(0, int(field.size() / 4) - 1));
          const Buffer payload = with_float(random_message(info, random), field, element, bits);
          bench_.say(from, frame_of(info, payload, bench_.next_envelope(from)));
          try_bad();
        }
      }
      bench_.pass(0.05);
    }
  }
  EXPECT_EQ(count_wrong(bench_), 0);
}

TEST_F(FaultTable, OverTheEnvelopeTheWholeVectorIsScaledAndTheChangeLimited) {
  const CommandLimits envelope = bench_switch().envelope;
  Random random("fault table: envelope");
  for (int i = 0; i < 20; ++i) {
    SwitchBench bench;
    const double size = std::pow(10, random.uniform(0.5, 6));
    const VelocityCommand wanted{random.uniform(-size, size), random.uniform(-size, size),
                                 random.uniform(-size, size), random.uniform(-size, size)};
    bench.fly(kVision, wanted, 4);  // longer than any speed takes at its acceleration
    try_bad(80);
    const Eigen::Vector4d end = bench.last_flown().velocity();
    const Eigen::Vector4d scaled = saturated(wanted, envelope.speed).vector();
    EXPECT_LT((end - scaled).norm(), 1e-4 * scaled.norm());
    SwitchBench::Flown last;
    last.time_s = bench.flown().front().time_s;
    for (const SwitchBench::Flown& flown : bench.flown()) {
      const Eigen::Array4d speed = flown.velocity().array().abs();
      ASSERT_TRUE((speed <= envelope.speed.vector().array()).all()) << flown.time_s;
      const Eigen::Array4d change = (flown.velocity() - last.velocity()).array().abs();
      const double step_s = flown.time_s - last.time_s;
      ASSERT_TRUE((change <= envelope.acceleration.vector().array() * step_s + 1e-6).all() ||
                  flown.is_zero())
          << flown.time_s;
      last = flown;
    }
  }
}

TEST_F(FaultTable, WhateverIsNoVelocityInTheHeadingFrameIsRefused) {
  bench_.fly(kVision, good(), 0.5);
  std::uint64_t tries = 0;
  for (int frame = 0; frame < 256; ++frame) {
    for (const int mask : {0x5C7, 0x000, 0xFFF, 0xDC7, 0x1C7, 0x5C6, 0x7C7}) {
      if (frame == kHeadingFrame && mask == kVelocityAndYawRate) continue;
      mavlink::SetPositionTarget asked = setpoint(bad(), bench_.now_s());
      asked.coordinate_frame = std::uint8_t(frame);
      asked.type_mask = std::uint16_t(mask);
      bench_.say(kVision, mavlink::Message(asked));
      bench_.pass(0.005);
      ++tries;
    }
  }
  try_bad(long(tries));
  EXPECT_EQ(bench_.refused(kVision, Refused::Unsupported), tries);
  EXPECT_EQ(count_wrong(bench_), 0);
}

/// Random bytes, intact random frames, and good setpoints with a few bytes changed and the checksum
/// made right again; from everybody, in datagrams and streams cut anywhere.
TEST_F(FaultTable, FuzzNothingThatIsNotFiniteOrNotAuthorisedIsEverForwarded) {
  for (const Transport transport : {Transport::Datagram, Transport::Stream}) {
    SwitchOptions options = bench_switch();
    for (SwitchLink& link : options.links) link.transport = transport;
    SwitchBench bench(options);
    Random random("fault table: fuzz");
    const PeerId peers[] = {kVision, kScript, kListener};
    constexpr int kTries = 15000;
    for (int i = 0; i < kTries; ++i) {
      const PeerId from = peers[random.integer(0, 2)];
      Buffer bytes;
      switch (random.integer(0, 3)) {
        case 0:
          bytes.resize(std::size_t(random.integer(0, 300)));
          for (auto& byte : bytes) byte = random_byte(random);
          break;
        case 1:
          bytes = random_frame(random);
          break;
        case 2:
          bytes = damaged(bench.frame(from, random_message(random)), random);
          break;
        default:  // one who is not the owner, or asks for something else than a velocity
          mavlink::SetPositionTarget asked = setpoint(bad(), bench.now_s());
          asked.coordinate_frame = std::uint8_t(random.integer(9, 255));
          bytes = bench.frame(from, asked);
      }
      bench.say(from, bytes);
      if (i % 8 == 0) bench.pass(SwitchBench::kStep_s);
    }
    try_bad(kTries);
    EXPECT_EQ(bench.state(), ControlState::Idle);
    EXPECT_EQ(count_wrong(bench), 0);
  }
}

}  // namespace
}  // namespace kestrel::test

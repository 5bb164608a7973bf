// The fault table of the link: what signing refuses. The companion's link has a key.
#include "kestrel/link/setpoint.hpp"
#include "kestrel/link/signing.hpp"

#include "link/fault_table.hpp"

namespace kestrel::test {
namespace {

using mavlink::SigningKey;

SigningKey key_of(std::uint8_t byte) {
  SigningKey::Secret secret{};
  secret.fill(byte);
  return SigningKey(secret);
}

SwitchOptions signed_switch() {
  SwitchOptions options = bench_switch();
  options.links[1].key = key_of(7);
  return options;
}

class SignedFaults : public FaultTable {
 protected:
  SignedFaults() { bench.mute(kVision); }

  /// A setpoint of the companion, signed with a key, shift_s from now by its own clock.
  Buffer signed_setpoint(const VelocityCommand& command, std::uint8_t key = 7, double shift_s = 0) {
    const auto setpoint = velocity_setpoint(command, time_boot_ms(bench.now_s()), {});
    // Each frame a little later than the one before, though the bench's clock stands.
    const mavlink::SigningStamp stamp{
        1, mavlink::signing_time(bench.time().unix_s + shift_s) + ++signed_};
    return copy(
        mavlink::signed_frame(setpoint, bench.next_envelope(kVision), stamp, key_of(key)).bytes());
  }

  void fly(double duration_s) {
    for (double end_s = bench.now_s() + duration_s; bench.now_s() < end_s;) {
      bench.say(kVision, signed_setpoint(good()));
      bench.pass(0.05);
    }
  }

  /// Says each of them, interleaved with good ones which must all be obeyed: what is refused
  /// changes nothing.
  void say_all(const std::vector<Buffer>& bad_ones) {
    const std::uint64_t before = bench.counters(kVision).setpoints;
    for (const Buffer& bytes : bad_ones) {
      bench.say(kVision, bytes);
      try_bad();
      bench.say(kVision, signed_setpoint(good()));
      bench.pass(0.02);
    }
    EXPECT_EQ(bench.counters(kVision).setpoints - before, bad_ones.size());
    EXPECT_EQ(count_wrong(bench), 0);
  }

  SwitchBench bench{signed_switch()};
  std::uint64_t signed_ = 0;
};

TEST_F(SignedFaults, GenuineCommandsAreObeyed) {
  fly(2);
  EXPECT_EQ(bench.owner()->peer, kVision);
  EXPECT_FALSE(bench.last_flown().is_zero());
}

TEST_F(SignedFaults, UnsignedCommandsAreRefused) {
  fly(0.5);
  std::vector<Buffer> all;
  for (int i = 0; i < 100; ++i) {
    all.push_back(
        bench.frame(kVision, velocity_setpoint(bad(), time_boot_ms(bench.now_s() + 0.02 * i), {})));
  }
  const std::uint64_t before = bench.refused(kVision, Refused::Unsigned);
  say_all(all);
  EXPECT_EQ(bench.refused(kVision, Refused::Unsigned) - before, 100u);
}

TEST_F(SignedFaults, ForgedCommandsAreRefused) {
  fly(0.5);
  std::vector<Buffer> all;
  for (int i = 0; i < 100; ++i) all.push_back(signed_setpoint(bad(), 8, 0.02 * i));
  say_all(all);
  EXPECT_EQ(bench.refused(kVision, Refused::BadSignature), 100u);
}

TEST_F(SignedFaults, TamperedCommandsAreRefusedWhateverBitIsChanged) {
  fly(0.5);
  // Of a frame whose content is bad, so that passing would show: every bit once.
  const std::size_t bits = signed_setpoint(bad()).size() * 8;
  const std::uint64_t before = bench.counters(kVision).refused_in_all();
  std::vector<Buffer> all;
  for (std::size_t bit = 0; bit < bits; ++bit) {
    Buffer frame = signed_setpoint(bad(), 7, 0.02 * double(bit) / 8);
    frame[bit / 8] = std::uint8_t(frame[bit / 8] ^ (1u << (bit % 8)));
    all.push_back(frame);
  }
  for (const Buffer& bytes : all) {
    bench.say(kVision, bytes);
    try_bad();
  }
  EXPECT_GE(bench.counters(kVision).refused_in_all() - before, bits);
  EXPECT_EQ(count_wrong(bench), 0);
  fly(0.5);
  EXPECT_FALSE(bench.last_flown().is_zero());
}

TEST_F(SignedFaults, ReplayedAndDoubledCommandsAreRefusedByTheirTime) {
  std::vector<Buffer> recorded;
  for (int i = 0; i < 100; ++i) {
    recorded.push_back(signed_setpoint(good()));
    bench.say(kVision, recorded.back());
    bench.say(kVision, recorded.back());
    try_bad();
    bench.pass(0.02);
  }
  EXPECT_EQ(bench.refused(kVision, Refused::Replayed), 100u);
  bench.pass(10);  // long since silent and stopped
  const double quiet_s = bench.now_s();
  EXPECT_TRUE(bench.last_flown().is_zero());
  for (const Buffer& bytes : recorded) {
    bench.say(kVision, bytes);
    try_bad();
    bench.pass(0.05);
  }
  bench.disconnect(kVision);  // nor by one who connects anew
  bench.connect(9, 1);
  for (const Buffer& bytes : recorded) {
    bench.say(9, bytes);
    try_bad();
    bench.pass(0.05);
  }
  for (const SwitchBench::Flown& flown : bench.flown_since(quiet_s)) {
    EXPECT_TRUE(flown.is_zero()) << flown.time_s;
  }
}

TEST_F(SignedFaults, CommandsShiftedInTimeAreRefused) {
  fly(0.5);
  std::vector<Buffer> all;
  for (const double shift_s : {-3600.0, -120.0, -61.0, 120.0, 3600.0, 1e9}) {
    all.push_back(signed_setpoint(bad(), 7, shift_s));
  }
  say_all(all);
  EXPECT_EQ(bench.refused(kVision, Refused::Replayed), all.size());
}

TEST_F(SignedFaults, WhatGoesOutOnASignedLinkIsSignedWithItsKey) {
  fly(2);
  bench.say(kFlight, mavlink::Message(mavlink::AttitudeReport{}));
  ASSERT_FALSE(bench.heard(kVision).empty());
  for (const SwitchBench::Heard& heard : bench.heard(kVision)) {
    const auto parsed = mavlink::parse(view(heard.bytes));
    const auto* frame = std::get_if<mavlink::FrameView>(&parsed.content);
    ASSERT_NE(frame, nullptr);
    EXPECT_TRUE(mavlink::signature_matches(*frame, key_of(7)));
  }
}

}  // namespace
}  // namespace kestrel::test

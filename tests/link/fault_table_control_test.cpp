// The fault table of the link, the other half: who commands, when, and how old it is.
#include <algorithm>
#include <cmath>

#include "kestrel/link/setpoint.hpp"

#include "link/fault_table.hpp"

namespace kestrel::test {
namespace {

double period_s() { return 1 / bench_switch().rate_hz; }
double deadman_s() { return bench_switch().deadman_s; }

/// When flight control got the last setpoint that moves, and the first zero after it.
struct Stop {
  double moved_s = -1;
  double zero_s = 1e9;
};

Stop stop_of(SwitchBench& bench) {
  Stop stop;
  for (const SwitchBench::Flown& flown : bench.flown()) {
    if (!flown.is_zero()) stop = {flown.time_s, 1e9};
    if (flown.is_zero() && stop.zero_s > 1e8) stop.zero_s = flown.time_s;
  }
  return stop;
}

TEST_F(FaultTable, AnOwnerThatFallsSilentIsAnExactZeroAtTheDeadmanAndNeverSilence) {
  bench_.fly(kVision, good(), 2);
  EXPECT_FALSE(bench_.last_flown().is_zero());
  bench_.command(kVision, good());
  const double last_s = bench_.now_s();
  bench_.pass(5);
  const Stop stop = stop_of(bench_);
  EXPECT_GE(stop.zero_s - last_s, deadman_s() - 1e-9);  // not before: one lost datagram is no fault
  EXPECT_LE(stop.zero_s - last_s, deadman_s() + period_s() + SwitchBench::kStep_s);
  std::printf("owner silent: exact zero %.3f s after its last command\n", stop.zero_s - last_s);
  double before_s = last_s;
  for (const SwitchBench::Flown& flown : bench_.flown_since(last_s)) {
    EXPECT_LE(flown.time_s - before_s, period_s() + SwitchBench::kStep_s + 1e-9);
    before_s = flown.time_s;
  }
  EXPECT_LE(bench_.now_s() - before_s, period_s() + SwitchBench::kStep_s + 1e-9);
  EXPECT_FALSE(bench_.events(SwitchEventKind::Deadman).empty());
}

TEST_F(FaultTable, ASilentOwnerHandsOverToTheNextLiveSourceWithAZeroBetween) {
  const VelocityCommand script{0, 0.5, 0, 0};
  for (int i = 0; i < 60; ++i) {  // both live; the script is not heard
    bench_.command(kVision, {0.5, 0, 0, 0});
    bench_.command(kScript, script);
    bench_.pass(0.05);
  }
  EXPECT_EQ(bench_.owner()->peer, kVision);
  EXPECT_GE(bench_.refused(kScript, Refused::NotOwner), 55u);
  const double silent_s = bench_.now_s();
  bench_.fly(kScript, script, 3);
  EXPECT_EQ(bench_.owner()->peer, kScript);
  EXPECT_NEAR(bench_.last_flown().velocity()[1], 0.5, 1e-6);
  bool zero_before_script = false;
  for (const SwitchBench::Flown& flown : bench_.flown_since(silent_s)) {
    if (flown.is_zero()) zero_before_script = true;
    EXPECT_TRUE(zero_before_script || flown.velocity()[1] == 0) << flown.time_s;
  }
}

TEST_F(FaultTable, StaleCommandsAreRefusedByTheirCaptureAge) {
  bench_.fly(kVision, good(), 1);
  const double ttl_s = bench_switch().time_to_live_s;
  for (int i = 0; i < 100; ++i) {  // fresh ones keep control; old ones come between
    bench_.command(kVision, good());
    bench_.pass(0.02);
    bench_.command(kVision, bad(), ttl_s + 0.01 * i + 0.05);
    try_bad();
    bench_.pass(0.03);
  }
  EXPECT_EQ(bench_.refused(kVision, Refused::Stale) + bench_.refused(kVision, Refused::Late), 100u);
  EXPECT_EQ(count_wrong(bench_), 0);
}

// In order and newer than all before, but a second late: what a queue on the way makes of them.
TEST_F(FaultTable, CommandsThatAQueueHeldUpAreRefusedByTheirCaptureAge) {
  bench_.fly(kVision, good(), 1);
  bench_.pass(1.1);
  for (int i = 0; i < 14; ++i) {
    bench_.command(kVision, bad(), 1);
    try_bad();
    bench_.pass(0.05);
  }
  EXPECT_EQ(bench_.refused(kVision, Refused::Stale), 14u);
  EXPECT_EQ(count_wrong(bench_), 0);
}

TEST_F(FaultTable, AFrozenFrameBehindALiveSenderIsNotObeyedLongerThanItLives) {
  bench_.fly(kVision, good(), 1);
  const double captured_s = bench_.now_s();
  while (bench_.now_s() < captured_s + 3) {  // new sequence numbers, an old picture
    bench_.say(kVision, mavlink::Message(velocity_setpoint(good(), time_boot_ms(captured_s), {})));
    try_bad();
    bench_.pass(0.05);
  }
  const Stop stop = stop_of(bench_);
  const double bound_s = std::max(bench_switch().time_to_live_s, deadman_s()) + period_s();
  EXPECT_LE(stop.zero_s - captured_s, bound_s + SwitchBench::kStep_s);
  std::printf("frozen frame: exact zero %.3f s after its capture\n", stop.zero_s - captured_s);
}

TEST_F(FaultTable, ReorderedAndDoubledCommandsAreRefusedBySequence) {
  bench_.fly(kVision, good(), 1);
  const std::uint64_t accepted = bench_.counters(kVision).setpoints;
  Buffer overtaken;
  for (int i = 0; i < 100; ++i) {
    overtaken =
        bench_.frame(kVision, velocity_setpoint(bad(), time_boot_ms(bench_.now_s() + 0.001), {}));
    const Buffer newer =
        bench_.frame(kVision, velocity_setpoint(good(), time_boot_ms(bench_.now_s()), {}));
    bench_.say(kVision, newer);
    bench_.pass(0.02);
    bench_.say(kVision, overtaken);  // its number is older, though its stamp is newer
    bench_.say(kVision, newer);
    try_bad(2);
    bench_.pass(0.02);
  }
  EXPECT_EQ(bench_.refused(kVision, Refused::Late), 100u);
  EXPECT_EQ(bench_.refused(kVision, Refused::Duplicate), 100u);
  EXPECT_EQ(bench_.counters(kVision).setpoints, accepted + 100);
  EXPECT_EQ(count_wrong(bench_), 0);
}

TEST_F(FaultTable, TwoSourcesAreNeverInterleaved) {
  for (int i = 0; i < 100; ++i) {
    bench_.command(kScript, bad());
    bench_.pass(0.01);
    bench_.command(kVision, good());
    bench_.pass(0.04);
    if (i == 0) continue;
    EXPECT_EQ(bench_.owner()->peer, kVision) << i;
    try_bad();
  }
  // The script spoke first and had control for 10 ms; its claim itself is a zero.
  EXPECT_EQ(count_wrong(bench_), 0);
  // The operator's word counts at once, with a zero first.
  const double asked_s = bench_.now_s();
  for (int i = 0; i < 40; ++i) {
    bench_.command(kVision, bad());
    bench_.command(kGround, {0, -0.5, 0, 0});
    bench_.pass(0.05);
    try_bad();
  }
  EXPECT_EQ(bench_.owner()->peer, kGround);
  const auto flown = bench_.flown_since(asked_s);
  bool zero = false;
  for (const SwitchBench::Flown& f : flown) {
    zero = zero || f.is_zero();
    EXPECT_TRUE(zero || f.velocity()[1] >= 0) << f.time_s;
  }
  EXPECT_NEAR(bench_.last_flown().velocity()[1], -0.5, 1e-6);
}

TEST_F(FaultTable, ALockKeepsControlFromEverybodyElse) {
  bench_.fly(kVision, good(), 1);
  bench_.control(kGround, SwitchControl::Lock);
  for (int i = 0; i < 50; ++i) {
    bench_.command(kVision, good());
    bench_.command(kScript, bad());
    bench_.command(kGround, bad());
    bench_.pass(0.05);
    try_bad(2);
  }
  EXPECT_EQ(bench_.owner()->peer, kVision);
  EXPECT_EQ(bench_.state(), ControlState::Locked);
  EXPECT_EQ(bench_.refused(kGround, Refused::Locked), 50u);
  EXPECT_EQ(count_wrong(bench_), 0);
  bench_.pass(deadman_s() + 2 * period_s());  // silent and locked: zeros, nobody else
  bench_.command(kScript, bad());
  bench_.pass(1);
  EXPECT_TRUE(bench_.last_flown().is_zero());
  EXPECT_EQ(count_wrong(bench_), 0);
}

TEST_F(FaultTable, TheOperatorsTakeOverDominatesAndSurvivesTheLossOfTheOperator) {
  bench_.fly(kVision, good(), 1);
  bench_.control(kGround, SwitchControl::TakeOver);
  bench_.pass(0.1);
  bench_.mute(kGround);
  bench_.disconnect(kGround);
  for (int i = 0; i < 200; ++i) {
    bench_.command(kVision, bad());
    bench_.command(kScript, bad());
    bench_.pass(0.05);
    try_bad(2);
  }
  EXPECT_EQ(bench_.state(), ControlState::TakenOver);
  EXPECT_TRUE(bench_.last_flown().is_zero());
  EXPECT_EQ(count_wrong(bench_), 0);
  bench_.connect(9, 2);  // another ground station lets go
  mavlink::CommandLong release;
  release.command = std::uint16_t(SwitchControl::Release);
  release.target_system = SwitchOptions{}.self.system_id;
  release.target_component = SwitchOptions{}.self.component_id;
  bench_.say(9, mavlink::encode(release, {254, 190, 0}).bytes());
  bench_.fly(kVision, good(), 2);
  EXPECT_EQ(bench_.owner()->peer, kVision);
  EXPECT_FALSE(bench_.last_flown().is_zero());
}

TEST_F(FaultTable, TheEmergencyStopIsLatchedWhateverAnybodySays) {
  bench_.fly(kVision, good(), 1);
  bench_.control(kGround, SwitchControl::EmergencyStop);
  const double stopped_s = bench_.now_s();
  EXPECT_TRUE(bench_.last_flown().is_zero());
  EXPECT_EQ(bench_.last_flown().time_s, stopped_s);  // at once, not at the next tick
  bench_.disconnect(kGround);
  for (int i = 0; i < 200; ++i) {
    for (const PeerId peer : {kVision, kScript, kListener}) {
      bench_.command(peer, bad());
      bench_.control(peer, SwitchControl::Reset);  // not theirs to say
      bench_.control(peer, SwitchControl::Release);
      try_bad(3);
    }
    bench_.pass(0.05);
  }
  EXPECT_EQ(bench_.state(), ControlState::Stopped);
  for (const SwitchBench::Flown& flown : bench_.flown_since(stopped_s + 1e-6)) {
    EXPECT_TRUE(flown.is_zero());
  }
  EXPECT_EQ(count_wrong(bench_), 0);
}

TEST_F(FaultTable, ASourceCountsAsDeadAfterFiveMissedHeartbeats) {
  bench_.fly(kVision, good(), 2);
  bench_.mute(kVision);  // goes on commanding: a thread that lives behind one that does not
  const double muted_s = bench_.now_s();
  bench_.fly(kVision, good(), 9);
  const Stop stop = stop_of(bench_);
  EXPECT_GE(stop.zero_s - muted_s, 4);  // the last beat may be a second old
  EXPECT_LE(stop.zero_s - muted_s, 5 + period_s() + SwitchBench::kStep_s);
  EXPECT_FALSE(bench_.events(SwitchEventKind::SourceDead).empty());
  EXPECT_GE(bench_.refused(kVision, Refused::Dead), 1u);
}

// Its connection says so: nobody waits for the deadman.
TEST_F(FaultTable, AnOwnerThatLeavesIsAnsweredByAZeroAtOnce) {
  bench_.fly(kVision, {0.3, 0, 0, 0}, 1);
  ASSERT_FALSE(bench_.last_flown().is_zero());
  const double left_s = bench_.now_s();
  bench_.disconnect(kVision);
  bench_.pass(2 * SwitchBench::kStep_s);
  const auto after = bench_.flown_since(left_s);
  ASSERT_FALSE(after.empty());
  EXPECT_TRUE(after.front().is_zero());
  EXPECT_LE(after.front().time_s - left_s, 2 * SwitchBench::kStep_s);
  EXPECT_FALSE(bench_.owner());
}

TEST_F(FaultTable, APeerThatRestartsIsHeardAgainAndOthersAreNotStalled) {
  bench_.fly(kVision, good(), 2);
  bench_.disconnect(kVision);
  const double gone_s = bench_.now_s();
  bench_.pass(0.2);
  EXPECT_TRUE(bench_.last_flown().is_zero());
  EXPECT_LE(stop_of(bench_).zero_s - gone_s, deadman_s() + period_s() + SwitchBench::kStep_s);
  bench_.connect(kVision, 1);
  bench_.fly(kVision, good(), 2);
  EXPECT_FALSE(bench_.last_flown().is_zero());
}

TEST_F(FaultTable, AFloodIsHeldBackAndFlightControlIsNotStarved) {
  bench_.fly(kVision, good(), 1);
  const double start_s = bench_.now_s();
  const std::uint64_t accepted = bench_.counters(kVision).setpoints;
  long flood = 0;
  std::uint64_t told = 0;
  while (bench_.now_s() < start_s + 2) {
    for (int i = 0; i < 50; ++i, ++flood) {  // 10 000 frames a second from each
      bench_.command(kScript, bad());
      bench_.say(kListener, mavlink::Message(mavlink::Heartbeat{}));
    }
    bench_.command(kVision, good());
    ++told;
    bench_.pass(SwitchBench::kStep_s);
  }
  try_bad(flood);
  EXPECT_GE(bench_.refused(kScript, Refused::TooFast), std::uint64_t(flood) / 2);
  EXPECT_EQ(bench_.counters(kVision).setpoints - accepted, told);  // all of them
  EXPECT_EQ(bench_.refused(kVision, Refused::TooFast), 0u);
  double before_s = start_s;
  for (const SwitchBench::Flown& flown : bench_.flown_since(start_s)) {
    EXPECT_LE(flown.time_s - before_s, period_s() + SwitchBench::kStep_s + 1e-9);
    before_s = flown.time_s;
  }
  // What reaches flight control, all together, stays within what a serial line carries.
  EXPECT_EQ(count_wrong(bench_), 0);
}

}  // namespace
}  // namespace kestrel::test

#include "kestrel/link/setpoint_stream.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr VelocityCommand kCommand{1, -2, 0.5, 0.25};

Eigen::Vector4d sent(const SetpointStream& stream, double now_s) {
  const auto setpoint = stream.at(now_s);
  return setpoint ? setpoint->command.vector() : Eigen::Vector4d::Constant(kNan);
}

TEST(SetpointStream, SendsZerosBeforeAnythingIsDecided) {
  const SetpointStream stream;
  for (const double now_s : {-5.0, 0.0, 1e6}) {
    EXPECT_TRUE(sent(stream, now_s).isZero(0));
    EXPECT_EQ(stream.at(now_s)->stamp_s, now_s);
    EXPECT_EQ(stream.state(now_s), StreamState::Waiting);
  }
}

TEST(SetpointStream, ACommandLivesFadesEndsInZerosAndThenInSilence) {
  SetpointStream stream;
  stream.decide(kCommand, 10, 10.05);
  EXPECT_EQ(sent(stream, 10.05), kCommand.vector());
  EXPECT_EQ(sent(stream, 10.25), kCommand.vector());
  EXPECT_EQ(stream.at(10.25)->stamp_s, 10);
  // One time constant later 1/e is left.
  EXPECT_LT((sent(stream, 10.35) - kCommand.vector() * std::exp(-1)).norm(), 1e-12);
  EXPECT_EQ(stream.at(10.35)->stamp_s, 10);  // still what was decided for that frame
  EXPECT_TRUE(sent(stream, 10.5).isZero(0));
  EXPECT_EQ(stream.at(10.5)->stamp_s, 10.5);  // zeros are decided now
  EXPECT_TRUE(sent(stream, 12.499).isZero(0));
  EXPECT_FALSE(stream.at(12.5));
  EXPECT_FALSE(stream.at(1e9));
  stream.decide(kCommand, 20, 20);
  EXPECT_EQ(sent(stream, 20.1), kCommand.vector());
}

TEST(SetpointStream, ZerosForEverWhenAsked) {
  SetpointStreamOptions options;
  options.then = AfterZeros::Zeros;
  SetpointStream stream(options);
  stream.decide(kCommand, 10, 10);
  EXPECT_TRUE(sent(stream, 1e9).isZero(0));
}

// The age counts from the capture, not from the arrival.
TEST(SetpointStream, AFrameThatComesLateIsOldWhenItComes) {
  SetpointStream stream;
  stream.decide(kCommand, 10, 10.4);
  EXPECT_LT(sent(stream, 10.4).norm(), kCommand.vector().norm() * 0.25);
  EXPECT_TRUE(sent(stream, 10.5).isZero(0));
  SetpointStream later;
  later.decide(kCommand, 10, 11);
  EXPECT_TRUE(sent(later, 11).isZero(0));
}

TEST(SetpointStream, AFrozenFrameBehindALivingThreadGrowsOld) {
  SetpointStream stream;
  stream.decide(kCommand, 10, 10);
  for (int i = 1; i < 300; ++i) stream.decide({5, 5, 5, 5}, i % 2 == 0 ? 10 : 9.9, 10 + i / 30.0);
  EXPECT_EQ(stream.counts().stale, 299);
  EXPECT_TRUE(sent(stream, 10.5).isZero(0));
  EXPECT_FALSE(stream.at(20));
}

TEST(SetpointStream, AFrameFromTheFutureLivesNoLonger) {
  SetpointStream stream;
  stream.decide(kCommand, 1e9, 10);
  EXPECT_EQ(sent(stream, 10.2), kCommand.vector());
  EXPECT_TRUE(sent(stream, 10.5).isZero(0));
}

TEST(SetpointStream, ZerosAreObeyedWhateverTheirStamp) {
  for (const double stamp_s : {10.0, 3.0, -1e9}) {
    SetpointStream stream;
    stream.decide(kCommand, 10, 10);
    stream.decide({}, stamp_s, 10.1);
    EXPECT_TRUE(sent(stream, 10.1).isZero(0));
    EXPECT_EQ(stream.counts().stale, 0);
    EXPECT_EQ(stream.age_s(10.1), 10.1 - 10);  // no younger by it
  }
}

TEST(SetpointStream, WhatIsNotFiniteBecomesZerosAtOnce) {
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e200}) {
    for (int k = 0; k < 5; ++k) {
      SetpointStream stream;
      stream.decide(kCommand, 10, 10);
      Eigen::Vector4d v = kCommand.vector();
      if (k < 4) v[k] = bad;
      // A stamp of 1e200 s is finite: of the future.
      const double stamp_s = k < 4 ? 10.1 : std::isfinite(bad) ? kNan : bad;
      stream.decide(VelocityCommand::from_vector(v), stamp_s, 10.1);
      EXPECT_TRUE(sent(stream, 10.1).isZero(0)) << bad << " at " << k;
      EXPECT_EQ(stream.counts().not_finite, 1);
    }
  }
}

TEST(SetpointStream, ATimeThatIsNoNumberGivesZeros) {
  SetpointStream stream;
  stream.decide(kCommand, 10, 10);
  EXPECT_TRUE(sent(stream, kNan).isZero(0));
}

// Whatever is decided and whenever it is asked: never more than what was decided for the newest
// frame, and nothing but zeros from zero_after_s on.
TEST(SetpointStream, NeverSendsMoreThanWasDecidedNorAnythingOld) {
  test::Random random("setpoint stream");
  for (int run = 0; run < 200; ++run) {
    SetpointStream stream;
    double now_s = random.uniform(-100, 100);
    double newest_s = -kInfinity;
    double decided = 0;
    for (int i = 0; i < 100; ++i) {
      now_s += random.uniform(0, 0.2);
      if (random.integer(0, 2) == 0) {
        const double capture_s = now_s - random.uniform(0, 0.6);
        const VelocityCommand command = VelocityCommand::from_vector(
            {random.normal(), random.normal(), random.normal(), random.normal()});
        stream.decide(command, capture_s, now_s);
        if (capture_s > newest_s) {
          newest_s = capture_s;
          decided = command.vector().norm();
        }
      }
      const auto setpoint = stream.at(now_s);
      if (!setpoint) {
        ASSERT_GE(now_s - newest_s, 2.5);
        continue;
      }
      const double speed = setpoint->command.vector().norm();
      ASSERT_LE(speed, decided * (1 + 1e-12));
      if (now_s - newest_s >= 0.5) {
        ASSERT_EQ(speed, 0);
      }
    }
  }
}

TEST(SetpointStreamOptions, NameWhatIsOutOfRange) {
  const auto complaint = [](auto change) {
    SetpointStreamOptions options;
    change(options);
    try {
      SetpointStream{options};
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).substr(0, std::string(error.what()).find(':'));
    }
    return std::string();
  };
  EXPECT_EQ(complaint([](auto&) {}), "");
  EXPECT_EQ(complaint([](auto& o) { o.time_to_live_s = 0; }), "time_to_live_s");
  EXPECT_EQ(complaint([](auto& o) { o.time_to_live_s = 0.6; }), "time_to_live_s");
  EXPECT_EQ(complaint([](auto& o) { o.decay_s = 0; }), "decay_s");
  EXPECT_EQ(complaint([](auto& o) { o.zero_after_s = 0.6; }), "zero_after_s");
  EXPECT_EQ(complaint([](auto& o) { o.zeros_for_s = -1; }), "zeros_for_s");
  for (const double bad : {kNan, kInfinity}) {
    EXPECT_EQ(complaint([&](auto& o) { o.time_to_live_s = bad; }), "time_to_live_s");
    EXPECT_EQ(complaint([&](auto& o) { o.decay_s = bad; }), "decay_s");
    EXPECT_NE(complaint([&](auto& o) { o.zero_after_s = bad; }), "");
    EXPECT_EQ(complaint([&](auto& o) { o.zeros_for_s = bad; }), "zeros_for_s");
  }
}

}  // namespace
}  // namespace kestrel

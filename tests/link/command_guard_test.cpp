#include "kestrel/link/command_guard.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "kestrel/link/setpoint.hpp"

#include "samples.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

const SourceId kEye{3, 1, 191};
const CommandGuardOptions kOptions{{2, 1.5, 1, 0.5}, 0.5, 2};

mavlink::SetPositionTarget stamped(double captured_s,
                                   const VelocityCommand& command = {1, 0, 0, 0}) {
  return velocity_setpoint(command, time_boot_ms(captured_s), {});
}

/// The reason, or empty when it is accepted.
std::optional<Refused> reason(CommandGuard& guard, double captured_s, double now_s,
                              const SourceId& source = kEye) {
  const auto verdict = guard.check(source, stamped(captured_s), Arrival::New, now_s);
  const auto* refused = std::get_if<Refused>(&verdict);
  return refused != nullptr ? std::optional(*refused) : std::nullopt;
}

TEST(RefusedContent, IsAnyFloatThatIsNotFiniteOrDenormal) {
  using S = mavlink::SetPositionTarget;
  using Limits = std::numeric_limits<float>;
  for (float S::*member :
       {&S::x_m, &S::y_m, &S::z_m, &S::vx_m_s, &S::vy_m_s, &S::vz_m_s, &S::ax_m_s2, &S::ay_m_s2,
        &S::az_m_s2, &S::yaw_rad, &S::yaw_rate_rad_s}) {
    for (const float bad : {Limits::quiet_NaN(), Limits::signaling_NaN(), Limits::infinity(),
                            -Limits::infinity(), Limits::denorm_min(), -Limits::min() / 2}) {
      S setpoint = stamped(0);
      setpoint.*member = bad;
      EXPECT_EQ(refused_content(setpoint), Refused::NotFinite);
    }
    for (const float good : {0.0F, -0.0F, Limits::min(), 1.0F, -Limits::max()}) {
      S setpoint = stamped(0);
      setpoint.*member = good;
      EXPECT_FALSE(refused_content(setpoint));
    }
  }
}

TEST(RefusedContent, IsAnyOtherFrameOrMask) {
  for (int frame = 0; frame < 256; ++frame) {
    auto setpoint = stamped(0);
    setpoint.coordinate_frame = std::uint8_t(frame);
    EXPECT_EQ(refused_content(setpoint).has_value(), frame != 8);
  }
  for (int mask = 0; mask < 65536; mask += 1) {
    auto setpoint = stamped(0);
    setpoint.type_mask = std::uint16_t(mask);
    ASSERT_EQ(refused_content(setpoint).has_value(), mask != 0x5C7) << mask;
  }
}

TEST(CommandGuard, PutsEveryCommandIntoTheEnvelopeByOneScale) {
  test::Random random("guard envelope");
  CommandGuard guard(kOptions);
  for (int i = 0; i < 2000; ++i) {
    VelocityCommand wanted;
    const double size = std::pow(10.0, random.uniform(-3, 30));
    wanted = {random.normal() * size, random.normal() * size, random.normal() * size,
              random.normal() * size};
    const auto verdict = guard.check(kEye, stamped(i / 30.0, wanted), Arrival::New, i / 30.0);
    const auto* accepted = std::get_if<GuardedSetpoint>(&verdict);
    ASSERT_NE(accepted, nullptr);
    const Eigen::Vector4d v = accepted->command.vector(), limit = kOptions.speed.vector();
    const Eigen::Vector4d floats = v.cast<float>().cast<double>();
    EXPECT_TRUE((floats.cwiseAbs().array() <= limit.array()).all());
    // The direction is kept, to the rounding of the wire's floats.
    EXPECT_NEAR(v.normalized().dot(wanted.vector().normalized()), 1, 1e-6);
    EXPECT_LE(v.norm(), wanted.vector().norm() * (1 + 1e-6));
  }
}

TEST(CommandGuard, RefusesByArrival) {
  CommandGuard guard(kOptions);
  EXPECT_FALSE(reason(guard, 1, 1));
  const auto refused = [&](Arrival arrival) {
    return std::get<Refused>(guard.check(kEye, stamped(1.1), arrival, 1.1));
  };
  EXPECT_EQ(refused(Arrival::Late), Refused::Late);
  EXPECT_EQ(refused(Arrival::Duplicate), Refused::Duplicate);
}

TEST(CommandGuard, RefusesWhatWasCapturedTooLongAgo) {
  for (const double offset_s : {0.0, 5000.0, -77.7}) {
    CommandGuard guard(kOptions);
    EXPECT_FALSE(reason(guard, 10 + offset_s, 10.02));
    EXPECT_FALSE(reason(guard, 10.4 + offset_s, 10.8));               // 0.38 s late
    EXPECT_EQ(reason(guard, 10.5 + offset_s, 11.1), Refused::Stale);  // 0.58 s late
    EXPECT_FALSE(reason(guard, 11.1 + offset_s, 11.15));              // fresh again
  }
}

TEST(CommandGuard, TellsWhenTheFrameWasCaptured) {
  CommandGuard guard(kOptions);
  EXPECT_FALSE(reason(guard, 100, 10));
  const auto verdict = guard.check(kEye, stamped(100.1), Arrival::New, 10.4);
  // Drift and the millisecond of the stamp.
  EXPECT_NEAR(std::get<GuardedSetpoint>(verdict).captured_s, 10.1, 0.001);
}

// A frozen eye behind a live sender: the same capture for ever, however often and long.
TEST(CommandGuard, RefusesAFrozenStampForEver) {
  CommandGuard guard(kOptions);
  for (double now_s = 5; now_s < 300; now_s += 0.1) {
    // kDrift lets a frozen stamp live longer by a part in 5000 of its age.
    EXPECT_EQ(reason(guard, 5, now_s).has_value(), now_s - 5 > 0.5001) << now_s;
  }
}

TEST(CommandGuard, RefusesCapturesThatGoBack) {
  CommandGuard guard(kOptions);
  EXPECT_FALSE(reason(guard, 1.0, 1.0));
  EXPECT_FALSE(reason(guard, 1.2, 1.2));
  EXPECT_FALSE(reason(guard, 1.2, 1.25));  // the same again, still young: a stream may repeat it
  EXPECT_EQ(reason(guard, 1.1, 1.3), Refused::Late);
}

TEST(CommandGuard, BelievesALeapOfTheClockFromTheSecondStampOn) {
  CommandGuard guard(kOptions);
  EXPECT_FALSE(reason(guard, 1, 1));
  EXPECT_EQ(reason(guard, 101, 1.1), Refused::FromTheFuture);
  EXPECT_FALSE(reason(guard, 1.2, 1.2));  // damage, then: the old clock is right
  EXPECT_EQ(reason(guard, 51, 1.3), Refused::FromTheFuture);
  EXPECT_FALSE(reason(guard, 51.1, 1.4));
  EXPECT_EQ(reason(guard, 1.5, 1.5), Refused::Stale);  // of the time before
}

TEST(CommandGuard, BelievesNoLeapsThatDoNotAgree) {
  CommandGuard guard(kOptions);
  EXPECT_FALSE(reason(guard, 1, 1));
  EXPECT_EQ(reason(guard, 101, 1.1), Refused::FromTheFuture);
  EXPECT_EQ(reason(guard, 201, 1.2), Refused::FromTheFuture);  // further still: another one
  EXPECT_FALSE(reason(guard, 1.3, 1.3));
  EXPECT_EQ(reason(guard, 201.2, 1.4), Refused::FromTheFuture);  // the old clock spoke in between
  EXPECT_FALSE(reason(guard, 201.3, 1.5));
}

TEST(CommandGuard, HearsAClockSetBackAfterASilence) {
  CommandGuard guard(kOptions);
  EXPECT_FALSE(reason(guard, 100, 10));
  for (double now_s = 10.1; now_s < 20; now_s += 0.1) {
    EXPECT_EQ(reason(guard, now_s, now_s), Refused::Stale);  // it never falls silent
  }
  EXPECT_FALSE(reason(guard, 22.1, 22.1));
}

// SIGSTOP, SIGCONT: the first setpoint after the pause is old, and what is accepted after it is
// not.
TEST(CommandGuard, IsRightFromTheThirdSetpointAfterAPause) {
  CommandGuard guard(kOptions);
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(reason(guard, 0.1 * i, 0.1 * i));
  EXPECT_FALSE(reason(guard, 1.0, 11.0));  // stopped at 1 s: only the loss of control guards here
  EXPECT_EQ(reason(guard, 11.1, 11.1), Refused::FromTheFuture);
  EXPECT_FALSE(reason(guard, 11.2, 11.2));
  EXPECT_EQ(reason(guard, 1.1, 11.3), Refused::Stale);
}

TEST(CommandGuard, KeepsSourcesApartAndBounded) {
  CommandGuard guard(kOptions);
  const int count = int(CommandGuard::kSourcesPerPeer);
  const auto id = [](int i) { return SourceId{3, std::uint8_t(i + 1), 1}; };
  for (int i = 0; i < count; ++i) EXPECT_FALSE(reason(guard, 1000.0 * i, 1, id(i)));
  EXPECT_EQ(reason(guard, 1, 1, id(count)), Refused::TooManySources);
  EXPECT_FALSE(reason(guard, 1, 1, {4, 1, 1}));  // another peer has room of its own
  EXPECT_FALSE(reason(guard, 1, 4, id(count)));  // the others have been silent for 3 s
  guard.forget(3);
  for (int i = 0; i < count; ++i) EXPECT_FALSE(reason(guard, 1, 4, id(i)));
}

TEST(FloatLimits, AreTheLargestFloatsNotAbove) {
  test::Random random("float limits");
  for (int i = 0; i < 1000; ++i) {
    const double limit = random.uniform(0.01, 5);
    const double floor = float_limits({limit, 1, 1, 1}).forward_m_s;
    EXPECT_EQ(floor, double(float(floor)));
    EXPECT_LE(floor, limit);
    EXPECT_GT(double(std::nextafter(float(floor), 10.0F)), limit);
  }
}

}  // namespace
}  // namespace kestrel

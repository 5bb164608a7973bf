#include "kestrel/link/telemetry.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"

#include "support/random.hpp"

namespace kestrel {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const Eigen::Vector3d kStill = Eigen::Vector3d::Zero();

Eigen::Matrix3d rotation(const Attitude& a) { return rotation_from_rpy(a.roll, a.pitch, a.yaw); }

double angle_between(const Attitude& a, const Attitude& b) {
  return rotation_vector(rotation(a).transpose() * rotation(b)).norm();
}

mavlink::AttitudeReport report(double time_s, const Attitude& a, const Eigen::Vector3d& rates) {
  return {std::uint32_t(std::llround(time_s * 1000)),
          float(a.roll),
          float(a.pitch),
          float(a.yaw),
          float(rates.x()),
          float(rates.y()),
          float(rates.z())};
}

mavlink::LocalPosition place(double time_s, const Eigen::Vector3d& p, const Eigen::Vector3d& v) {
  return {std::uint32_t(std::llround(time_s * 1000)),
          float(p.x()),
          float(p.y()),
          float(p.z()),
          float(v.x()),
          float(v.y()),
          float(v.z())};
}

/// Floats of the wire: 2^-24 of an angle of up to pi, of metres up to 100.
constexpr double kFloat = 1e-6;

// A body that turns evenly about any axis is where slerp says at every instant in between, and
// where its rates say beyond the last sample.
TEST(Telemetry, FollowsABodyThatTurnsEvenly) {
  test::Random random("telemetry turns");
  for (int run = 0; run < 50; ++run) {
    const Attitude start{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5),
                         random.uniform(-M_PI, M_PI)};
    const Eigen::Vector3d rates = random.vector3(1.5);
    const auto truth = [&](double t) {
      return Eigen::Matrix3d(rotation(start) * rotation_from_vector(rates * t));
    };
    Telemetry telemetry;
    for (int i = 0; i <= 10; ++i) {
      const Eigen::Matrix3d R = truth(i * 0.02);
      const Attitude a{std::atan2(R(2, 1), R(2, 2)), std::asin(-R(2, 0)),
                       std::atan2(R(1, 0), R(0, 0))};
      telemetry.take(report(i * 0.02, a, rates), 100 + i * 0.02, std::nullopt);
    }
    for (double t = 0; t <= 0.3; t += 0.003) {
      const auto found = telemetry.attitude_at(100 + t);
      ASSERT_TRUE(found) << t;
      EXPECT_LT(rotation_vector(truth(t).transpose() * rotation(*found)).norm(), 2 * kFloat) << t;
    }
  }
}

TEST(Telemetry, GoesTheShortWayRoundSouth) {
  Telemetry telemetry;
  telemetry.take(report(1, {0, 0, M_PI - 0.1}, kStill), 1, std::nullopt);
  telemetry.take(report(1.1, {0, 0, -M_PI + 0.1}, kStill), 1.1, std::nullopt);
  EXPECT_LT(angle_between(*telemetry.attitude_at(1.05), {0, 0, M_PI}), kFloat);
  EXPECT_LT(angle_between(*telemetry.attitude_at(1.025), {0, 0, M_PI - 0.05}), kFloat);
}

TEST(Telemetry, SaysNothingWhereNothingIsKnown) {
  Telemetry telemetry;
  EXPECT_FALSE(telemetry.attitude_at(1));
  EXPECT_FALSE(telemetry.motion_at(1));
  for (const double t : {1.0, 1.1, 2.0, 2.1}) {
    telemetry.take(report(t, {0.1, 0, 0}, kStill), t, std::nullopt);
    telemetry.take(place(t, {1, 2, 3}, kStill), t, std::nullopt);
  }
  for (const double t : {0.99, 1.5, 2.21, 1e9, kNan}) {
    EXPECT_FALSE(telemetry.attitude_at(t)) << t;
    EXPECT_FALSE(telemetry.motion_at(t)) << t;
  }
  for (const double t : {1.0, 1.05, 1.1, 2.0, 2.1, 2.19}) {
    EXPECT_TRUE(telemetry.attitude_at(t)) << t;
    EXPECT_TRUE(telemetry.motion_at(t)) << t;
  }
}

TEST(Telemetry, FollowsTheStraightLine) {
  Telemetry telemetry;
  telemetry.take(place(1, {1, 2, -3}, {1, 0, -1}), 10, std::nullopt);
  telemetry.take(place(1.2, {2, 2, -4}, {2, 0, -1}), 10.2, std::nullopt);
  const auto middle = telemetry.motion_at(10.05);
  EXPECT_LT((middle->position_ned_m - Eigen::Vector3d(1.25, 2, -3.25)).norm(), kFloat);
  EXPECT_LT((middle->velocity_ned_m_s - Eigen::Vector3d(1.25, 0, -1)).norm(), kFloat);
  const auto beyond = telemetry.motion_at(10.25);
  EXPECT_LT((beyond->position_ned_m - Eigen::Vector3d(2.1, 2, -4.05)).norm(), kFloat);
}

// 40 ms on the way, the clocks 1000 s apart: with the estimate a sample is where it was measured.
TEST(Telemetry, DatesASampleByItsOwnTimeWhereTheClockIsKnown) {
  const ClockEstimate clock{1000, 0.02, 0.01};
  Telemetry dated;
  Telemetry undated;
  for (int i = 0; i < 10; ++i) {
    const double measured_s = 5 + i * 0.02;
    const auto message = report(measured_s + 1000, {0, 0, measured_s}, kStill);
    dated.take(message, measured_s + 0.04, clock);
    undated.take(message, measured_s + 0.04, std::nullopt);
  }
  EXPECT_NEAR(wrap_angle(dated.attitude_at(5.1)->yaw - 5.1), 0, 1e-5);
  EXPECT_NEAR(wrap_angle(undated.attitude_at(5.14)->yaw - 5.1), 0, 1e-5);
  EXPECT_EQ(dated.counts().misdated, 0);
}

TEST(Telemetry, TheClockOfTheWireTurnsOver) {
  const double turn_s = 4294967.296;
  const ClockEstimate clock{turn_s - 10, 0.02, 0.01};  // our 10 s is their turn
  Telemetry telemetry;
  telemetry.take(report(turn_s - 0.1, {0, 0, 1}, kStill), 9.92, clock);
  telemetry.take(report(0.1, {0, 0, 2}, kStill), 10.12, clock);
  EXPECT_NEAR(telemetry.attitude_at(10)->yaw, 1.5, 1e-5);
  EXPECT_EQ(telemetry.counts().misdated, 0);
}

TEST(Telemetry, DoesNotBelieveATimeFarFromTheArrival) {
  Telemetry telemetry;
  telemetry.take(report(500, {0, 0, 1}, kStill), 10, ClockEstimate{0, 0.02, 0.01});
  EXPECT_EQ(telemetry.counts().misdated, 1);
  EXPECT_NEAR(telemetry.attitude_at(10)->yaw, 1, kFloat);
  // Nor in one from the future, which would hold up all that follow.
  telemetry.take(report(10.9, {0, 0, 1}, kStill), 10.1, ClockEstimate{0, 0.02, 0.01});
  telemetry.take(report(10.2, {0, 0, 2}, kStill), 10.2, ClockEstimate{0, 0.02, 0.01});
  EXPECT_NEAR(telemetry.attitude_at(10.2)->yaw, 2, kFloat);
}

TEST(Telemetry, PassesOverWhatIsNotFiniteAndWhatIsNotNewer) {
  Telemetry telemetry;
  telemetry.take(report(1, {0.3, 0, 0}, kStill), 1, std::nullopt);
  telemetry.take(report(1.1, {kNan, 0, 0}, kStill), 1.1, std::nullopt);
  telemetry.take(report(1.1, {0, 0, 0}, {0, kNan, 0}), 1.1, std::nullopt);
  telemetry.take(place(1.1, {0, kNan, 0}, kStill), 1.1, std::nullopt);
  EXPECT_EQ(telemetry.counts().not_finite, 3);
  telemetry.take(report(1, {0.9, 0, 0}, kStill), 1, std::nullopt);
  telemetry.take(report(1, {0.9, 0, 0}, kStill), 0.9, std::nullopt);
  EXPECT_EQ(telemetry.counts().out_of_order, 2);
  EXPECT_NEAR(telemetry.attitude_at(1)->roll, 0.3, kFloat);
  EXPECT_FALSE(telemetry.motion_at(1.1));
  EXPECT_EQ(telemetry.counts().attitudes, 1);
}

TEST(Telemetry, StartsAnewWhenTheTimeGoesBack) {
  Telemetry telemetry;
  telemetry.take(report(1, {0.3, 0, 0}, kStill), 100, std::nullopt);
  telemetry.take(report(1, {0.5, 0, 0}, kStill), 50, std::nullopt);
  EXPECT_EQ(telemetry.counts().restarts, 1);
  EXPECT_NEAR(telemetry.attitude_at(50)->roll, 0.5, kFloat);
  EXPECT_FALSE(telemetry.attitude_at(100));
}

TEST(Telemetry, ForgetsWhatIsOld) {
  Telemetry telemetry;
  for (int i = 0; i < 1000; ++i) {
    telemetry.take(report(i * 0.02, {}, kStill), i * 0.02, std::nullopt);
  }
  EXPECT_FALSE(telemetry.attitude_at(19.98 - 5.03));
  EXPECT_TRUE(telemetry.attitude_at(19.98 - 4.99));
}

TEST(Telemetry, KnowsModeArmingAndWhereTheGroundIs) {
  Telemetry telemetry;
  telemetry.take(mavlink::ExtendedSysState{0, 2}, 1, std::nullopt);
  EXPECT_FALSE(telemetry.state());
  mavlink::Heartbeat beat;
  beat.custom_mode = 4;
  telemetry.take(beat, 2, std::nullopt);
  ASSERT_TRUE(telemetry.state());
  EXPECT_EQ(telemetry.state()->heartbeat.custom_mode, 4u);
  EXPECT_EQ(telemetry.state()->heard_s, 2);
  EXPECT_EQ(telemetry.state()->landed, Landed::InAir);
  EXPECT_FALSE(telemetry.state()->down_m);
  telemetry.take(mavlink::ExtendedSysState{0, 1}, 3, std::nullopt);
  telemetry.take(place(3, {0, 0, -2}, kStill), 3, std::nullopt);
  EXPECT_EQ(telemetry.state()->landed, Landed::OnGround);
  EXPECT_EQ(telemetry.state()->down_m, -2);
  EXPECT_EQ(telemetry.state()->heard_s, 2);
  telemetry.take(mavlink::ExtendedSysState{0, 77}, 4, std::nullopt);
  EXPECT_EQ(telemetry.state()->landed, Landed::Unknown);
  EXPECT_STREQ(name(Landed::OnGround), "on the ground");
}

TEST(Telemetry, KnowsTheBatteryOnceItWasTold) {
  Telemetry telemetry;
  telemetry.take(mavlink::Heartbeat{}, 1, std::nullopt);
  EXPECT_FALSE(telemetry.state()->battery);
  telemetry.take(sys_status({11.8, std::nullopt, 0.4}), 2, std::nullopt);
  ASSERT_TRUE(telemetry.state()->battery);
  EXPECT_NEAR(telemetry.state()->battery->charge.value(), 0.4, 1e-9);
  EXPECT_FALSE(telemetry.state()->battery->current_a) << "not known stays not known";
  telemetry.take(mavlink::Heartbeat{}, 3, std::nullopt);
  EXPECT_TRUE(telemetry.state()->battery) << "a heartbeat does not forget it";
}

TEST(TelemetryOptions, NameWhatIsOutOfRange) {
  for (const double bad : {-1.0, kNan, std::numeric_limits<double>::infinity()}) {
    TelemetryOptions options;
    options.history_s = bad;
    EXPECT_THROW(Telemetry{options}, std::invalid_argument);
    options = {};
    options.extrapolate_s = bad;
    EXPECT_THROW(Telemetry{options}, std::invalid_argument);
    options = {};
    options.widest_gap_s = bad;
    EXPECT_THROW(Telemetry{options}, std::invalid_argument);
  }
}

}  // namespace
}  // namespace kestrel

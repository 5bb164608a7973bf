#include "kestrel/vehicle/limits.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

using Eigen::Vector4d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
// A scale and a product: two roundings of numbers below 10.
constexpr double kRounding = 1e-14;

VelocityCommand random_command(test::Random& random, double size) {
  return VelocityCommand::from_vector({random.uniform(-size, size), random.uniform(-size, size),
                                       random.uniform(-size, size), random.uniform(-size, size)});
}

/// b = s a with 0 <= s <= 1.
void expect_shortened(const Vector4d& a, const Vector4d& b) {
  const double s = a.dot(b) / a.squaredNorm();
  EXPECT_GE(s, 0);
  EXPECT_LE(s, 1 + kRounding);
  EXPECT_LT((b - s * a).norm(), kRounding * a.norm());
}

TEST(Saturated, IsBoundedParallelAndIdempotent) {
  test::Random random("saturated");
  const VelocityCommand limit = CommandLimits{}.speed;
  int shortened = 0;
  for (int i = 0; i < 2000; ++i) {
    const VelocityCommand command = random_command(random, 4);
    const VelocityCommand once = saturated(command, limit);
    for (int k = 0; k < 4; ++k) EXPECT_LE(std::abs(once.vector()[k]), limit.vector()[k]);
    expect_shortened(command.vector(), once.vector());
    EXPECT_EQ(saturated(once, limit).vector(), once.vector());
    shortened += once.vector() != command.vector();
  }
  EXPECT_GT(shortened, 1000);
}

// Not only bounded: as fast as the limits allow, one of them is reached.
TEST(Saturated, ReachesALimitWhenItShortens) {
  test::Random random("saturated reaches");
  const Vector4d limit = CommandLimits{}.speed.vector();
  for (int i = 0; i < 500; ++i) {
    const VelocityCommand command = random_command(random, 4);
    const Vector4d ratio = command.vector().cwiseAbs().cwiseQuotient(limit);
    if (ratio.maxCoeff() <= 1) continue;
    const Vector4d left =
        saturated(command, CommandLimits{}.speed).vector().cwiseAbs().cwiseQuotient(limit);
    EXPECT_NEAR(left.maxCoeff(), 1, kRounding);
  }
}

TEST(Saturated, LeavesWhatIsWithinTheLimits) {
  const VelocityCommand limit = CommandLimits{}.speed;
  EXPECT_EQ(saturated(limit, limit).vector(), limit.vector());
  EXPECT_EQ(saturated(VelocityCommand::hover(), limit).vector(), Vector4d::Zero());
  const VelocityCommand small{-1.9, 1.4, -0.9, 0.5};
  EXPECT_EQ(saturated(small, limit).vector(), small.vector());
}

// One number too large slows all four: 4 m/s forward of 2 allowed halves the rest as well.
TEST(Saturated, ScalesAllFourTogether) {
  const VelocityCommand command = saturated({4, 1, -0.5, 0.2}, CommandLimits{}.speed);
  EXPECT_EQ(command.vector(), Vector4d(2, 0.5, -0.25, 0.1));
}

TEST(Slewed, StaysOnTheSegmentWithinTheAcceleration) {
  test::Random random("slewed");
  const VelocityCommand acceleration = CommandLimits{}.acceleration;
  int shortened = 0;
  for (int i = 0; i < 2000; ++i) {
    const VelocityCommand previous = random_command(random, 2);
    const VelocityCommand wanted = random_command(random, 2);
    const double duration_s = random.uniform(0.001, 2);
    const VelocityCommand command = slewed(previous, wanted, acceleration, duration_s);
    const Vector4d change = command.vector() - previous.vector();
    for (int k = 0; k < 4; ++k) {
      EXPECT_LE(std::abs(change[k]), acceleration.vector()[k] * duration_s + kRounding);
    }
    const Vector4d whole = wanted.vector() - previous.vector();
    expect_shortened(whole, change);
    shortened += command.vector() != wanted.vector();
    // No slower than it has to be: the end is reached, or a limit is.
    const Vector4d used = change.cwiseAbs().cwiseQuotient(acceleration.vector() * duration_s);
    EXPECT_TRUE(command.vector() == wanted.vector() || std::abs(used.maxCoeff() - 1) < 1e-11);
  }
  EXPECT_GT(shortened, 500);
}

TEST(Slewed, ArrivesExactlyAndStays) {
  test::Random random("slewed arrives");
  const VelocityCommand acceleration = CommandLimits{}.acceleration;
  for (int i = 0; i < 100; ++i) {
    VelocityCommand command = random_command(random, 2);
    const VelocityCommand wanted = random_command(random, 2);
    // At most 4 m/s to change by, 1.0472 per s for the slowest: below 4 s, 120 frames.
    for (int k = 0; k < 120; ++k) command = slewed(command, wanted, acceleration, 1.0 / 30);
    EXPECT_EQ(command.vector(), wanted.vector());
  }
}

TEST(Slewed, KeepsThePreviousCommandForNoDuration) {
  const VelocityCommand previous{1, 0.5, -0.25, 0.1};
  const VelocityCommand wanted{-1, 0, 0, 0};
  for (const double duration_s : {0.0, -0.1}) {
    const VelocityCommand kept = slewed(previous, wanted, CommandLimits{}.acceleration, duration_s);
    EXPECT_EQ(kept.vector(), previous.vector());
  }
}

TEST(Limited, IsBoundedInSpeedAndChangeAlongAFlight) {
  test::Random random("limited");
  const CommandLimits limits;
  VelocityCommand sent;
  for (int i = 0; i < 3000; ++i) {
    const double duration_s = random.uniform(0, 0.2);
    const VelocityCommand wanted = random_command(random, 5);
    const VelocityCommand command = limited(sent, wanted, limits, duration_s);
    for (int k = 0; k < 4; ++k) {
      EXPECT_LE(std::abs(command.vector()[k]), limits.speed.vector()[k] + kRounding);
      EXPECT_LE(std::abs(command.vector()[k] - sent.vector()[k]),
                limits.acceleration.vector()[k] * duration_s + kRounding);
    }
    sent = command;
  }
}

// First the speed, then the change: the other order would head for a point that may not be reached.
TEST(Limited, HeadsForTheSaturatedCommand) {
  const CommandLimits limits;
  const VelocityCommand wanted{20, 1.5, 0, 0};  // saturated: 2, 0.15
  EXPECT_LT((limited({}, wanted, limits, 100).vector() - Vector4d(2, 0.15, 0, 0)).norm(),
            kRounding);
  // A quarter of a second: 0.5 of the 2 m/s forward, the same share to the right.
  EXPECT_LT((limited({}, wanted, limits, 0.25).vector() - Vector4d(0.5, 0.0375, 0, 0)).norm(),
            kRounding);
}

TEST(Limits, AreHoverForAnythingNotFinite) {
  const CommandLimits limits;
  const VelocityCommand moving{1, 1, 0.5, 0.2};
  for (const double bad : {kNan, kInf, -kInf}) {
    for (int i = 0; i < 4; ++i) {
      Vector4d v = moving.vector();
      v[i] = bad;
      const VelocityCommand broken = VelocityCommand::from_vector(v);
      EXPECT_EQ(saturated(broken, limits.speed).vector(), Vector4d::Zero());
      EXPECT_EQ(saturated(moving, broken).vector(), Vector4d::Zero());
      EXPECT_EQ(slewed(broken, moving, limits.acceleration, 0.1).vector(), Vector4d::Zero());
      EXPECT_EQ(slewed(moving, broken, limits.acceleration, 0.1).vector(), Vector4d::Zero());
      EXPECT_EQ(slewed(moving, moving, broken, 0.1).vector(), Vector4d::Zero());
      EXPECT_EQ(limited(moving, broken, limits, 0.1).vector(), Vector4d::Zero());
      EXPECT_EQ(limited(broken, moving, limits, 0.1).vector(), Vector4d::Zero());
    }
    EXPECT_EQ(slewed(moving, moving, limits.acceleration, bad).vector(), Vector4d::Zero());
    EXPECT_EQ(limited(moving, moving, limits, bad).vector(), Vector4d::Zero());
  }
}

// Finite numbers whose difference overflows.
TEST(Limits, AreFiniteForHugeNumbers) {
  const double huge = std::numeric_limits<double>::max();
  const VelocityCommand up{huge, huge, huge, huge};
  const VelocityCommand down{-huge, -huge, -huge, -huge};
  EXPECT_TRUE(is_finite(saturated(up, CommandLimits{}.speed)));
  EXPECT_TRUE(is_finite(slewed(up, down, CommandLimits{}.acceleration, 0.1)));
  EXPECT_TRUE(is_finite(slewed(up, down, up, huge)));
}

std::string complaint(const CommandLimits& limits) {
  try {
    limits.check();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(CommandLimits, CheckNamesTheLimitAndItsUnit) {
  EXPECT_EQ(complaint({}), "");
  for (const double bad : {0.0, -1.0, kNan, kInf}) {
    CommandLimits limits;
    limits.speed.right_m_s = bad;
    EXPECT_THAT(complaint(limits), testing::StartsWith("speed.right_m_s: must be positive and "
                                                       "finite (m/s), is "));
    limits = {};
    limits.acceleration.yaw_rate_rad_s = bad;
    EXPECT_THAT(complaint(limits), testing::StartsWith("acceleration.yaw_rate_rad_s: must be "
                                                       "positive and finite (rad/s per s), is "));
  }
  CommandLimits limits;
  limits.speed.forward_m_s = 0;
  EXPECT_THAT(complaint(limits), testing::StartsWith("speed.forward_m_s"));
  limits = {};
  limits.speed.down_m_s = 0;
  EXPECT_THAT(complaint(limits), testing::StartsWith("speed.down_m_s"));
}

}  // namespace
}  // namespace kestrel

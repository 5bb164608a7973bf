#include "kestrel/vehicle/failsafe.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kestrel {
namespace {

using Eigen::Vector4d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
const VelocityCommand kLast{1.5, -1, 0.5, 0.25};

TEST(Failsafe, HoldsTheLastCommand) {
  for (const double unseen_s : {0.0, 0.03, 0.1}) {
    const FailsafeCommand answer = after_loss(kLast, unseen_s, {});
    EXPECT_EQ(answer.command.vector(), kLast.vector());
    EXPECT_EQ(answer.state, CommandState::Hold);
  }
}

TEST(Failsafe, DecaysWithItsTimeConstant) {
  for (const double unseen_s : {0.11, 0.3, 0.5, 0.999}) {
    const FailsafeCommand answer = after_loss(kLast, unseen_s, {});
    EXPECT_EQ(answer.state, CommandState::Decay);
    const Vector4d expected = std::exp(-(unseen_s - 0.1) / 0.4) * kLast.vector();
    EXPECT_LT((answer.command.vector() - expected).norm(), 1e-15);
  }
  // One time constant after the hold: 1/e is left.
  EXPECT_NEAR(after_loss(kLast, 0.5, {}).command.forward_m_s, 1.5 * 0.36787944117144233, 1e-15);
}

TEST(Failsafe, IsExactlyZeroAtTheEnd) {
  for (const double unseen_s : {1.0, 1.5, 1e9, kInf}) {
    const FailsafeCommand answer = after_loss(kLast, unseen_s, {});
    EXPECT_EQ(answer.command.vector(), Vector4d::Zero());
    EXPECT_EQ(answer.state, CommandState::Hover);
  }
}

// The distance flown after the loss: hold and decay, v (0.1 + 0.4 (1 - exp(-0.9 / 0.4))).
TEST(Failsafe, StopsWithinTheDistanceOfHoldAndDecay) {
  const double dt_s = 1e-4;
  double flown_m = 0;
  for (int i = 0; i < 40000; ++i) {
    flown_m += after_loss(kLast, (i + 0.5) * dt_s, {}).command.forward_m_s * dt_s;
  }
  // One interval of 1e-4 s of 1.5 m/s may fall on the wrong side of each of two borders.
  EXPECT_NEAR(flown_m, 1.5 * (0.1 + 0.4 * (1 - std::exp(-0.9 / 0.4))), 3e-4);
}

TEST(Failsafe, NeverGrows) {
  double before = kInf;
  for (double unseen_s = 0; unseen_s < 2; unseen_s += 0.01) {
    const double norm = after_loss(kLast, unseen_s, {}).command.vector().norm();
    EXPECT_LE(norm, before);
    before = norm;
  }
}

TEST(Failsafe, GoesStraightToHoverWhenHoldAndHoverMeet) {
  const LossOptions options{0.2, 0.4, 0.2};
  EXPECT_EQ(after_loss(kLast, 0.19, options).state, CommandState::Hold);
  EXPECT_EQ(after_loss(kLast, 0.2, options).state, CommandState::Hover);
}

TEST(Failsafe, HoversForNonsense) {
  for (const double unseen_s : {-0.01, kNan, -kInf}) {
    const FailsafeCommand answer = after_loss(kLast, unseen_s, {});
    EXPECT_EQ(answer.command.vector(), Vector4d::Zero());
    EXPECT_EQ(answer.state, CommandState::Hover);
  }
  for (int i = 0; i < 4; ++i) {
    for (const double bad : {kNan, kInf, -kInf}) {
      Vector4d v = kLast.vector();
      v[i] = bad;
      for (const double unseen_s : {0.05, 0.5}) {
        const FailsafeCommand answer = after_loss(VelocityCommand::from_vector(v), unseen_s, {});
        EXPECT_EQ(answer.command.vector(), Vector4d::Zero());
        EXPECT_EQ(answer.state, CommandState::Hover);
      }
    }
  }
  LossOptions unchecked;  // 0 s: the decay is over at once
  unchecked.decay_s = 0;
  EXPECT_TRUE(is_finite(after_loss(kLast, 0.5, unchecked).command));
}

std::string complaint(const LossOptions& options) {
  try {
    options.check();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(LossOptions, CheckNamesTheOptionAndItsUnit) {
  using testing::MatchesRegex;
  EXPECT_EQ(complaint({}), "");
  EXPECT_EQ(complaint({0, 0.4, 1}), "");
  for (const double bad : {-0.1, kNan, kInf}) {
    EXPECT_THAT(complaint({bad, 0.4, 1}), MatchesRegex("hold_s: .*\\(s\\), is .*"));
    EXPECT_THAT(complaint({0.1, bad, 1}), MatchesRegex("decay_s: .*\\(s\\), is .*"));
    EXPECT_THAT(complaint({0.1, 0.4, bad}), MatchesRegex("hover_after_s: .*\\(s\\), is .*"));
  }
  EXPECT_THAT(complaint({0.1, 0, 1}), MatchesRegex("decay_s: .*"));
  EXPECT_THAT(complaint({0.5, 0.4, 0.4}), MatchesRegex("hover_after_s: .*hold_s.*"));
  EXPECT_THAT(complaint({0, 0.4, 0}), MatchesRegex("hover_after_s: .*"));
}

TEST(CommandState, HasAName) {
  EXPECT_STREQ(name(CommandState::Servo), "servo");
  EXPECT_STREQ(name(CommandState::Hold), "hold");
  EXPECT_STREQ(name(CommandState::Decay), "decay");
  EXPECT_STREQ(name(CommandState::Hover), "hover");
  EXPECT_STREQ(name(CommandState::Sticks), "sticks");
  for (std::size_t i = 0; i < kCommandStates.size(); ++i) {
    EXPECT_EQ(kCommandStates[i], CommandState(i));
  }
}

}  // namespace
}  // namespace kestrel

#include "kestrel/loop/decide.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "loop/flight.hpp"
#include "servo/oracle.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

using Eigen::Vector4d;
using test::Flight;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kFrame = 1.0 / 30;
constexpr Law kLaws[] = {Law::Cur, Law::Des, Law::Mean};
const Mount kMounts[] = {test::forward_camera(), test::down_camera()};

/// Limits that never act.
const CommandLimits kNoLimits{{1e3, 1e3, 1e3, 1e3}, {1e6, 1e6, 1e6, 1e6}};

Flight random_flight(test::Random& random) {
  return {random.vector3(0.5),
          {random.uniform(-0.25, 0.25), random.uniform(-0.25, 0.25), random.uniform(-0.3, 0.3)}};
}

/// Decides in the middle of a run: a frame ago a hover was sent.
Decision decide_at(const Flight& flight, const Task& task) {
  DecisionState state;
  state.stamp_s = 10;
  const auto measured =
      test::seen_from(flight.camera(task.body_from_camera), test::target_for(task), task);
  return decide(measured, flight.attitude, 10 + kFrame, state, task);
}

// The whole road from tilted features to the wanted command against the law written again: levelled
// points, the lever arm of the tilted camera, the basis of the chosen freedom.
TEST(Decide, WantsWhatTheLawOfThePapersWants) {
  test::Random random("decide oracle");
  for (const Mount& mount : kMounts) {
    for (const Law law : kLaws) {
      for (const Freedom freedom : {Freedom::Four, Freedom::Three}) {
        for (int i = 0; i < 20; ++i) {
          Task task = test::example_task(mount);
          task.servo = {law, freedom, random.uniform(0.2, 2)};
          const Flight flight = random_flight(random);
          const Decision decision = decide_at(flight, task);
          ASSERT_TRUE(decision.servo);
          const Attitude& tilt = flight.attitude;
          const Mount level{mount.rotation,
                            test::turn_y(tilt.pitch) * test::turn_x(tilt.roll) * mount.translation};
          const auto seen =
              test::seen_from(flight.level_camera(mount), test::target_for(task), task);
          const auto goal = features(task.goal, target_corners(task));
          const Vector6d v = test::oracle_servo(seen, goal, level, task.servo).twist;
          // Back to the body: the velocity of a point of a rigid body, at the body's origin.
          const Eigen::Vector3d w = mount.rotation * v.tail<3>();
          const Eigen::Vector3d u = mount.rotation * v.head<3>() - w.cross(level.translation);
          const Vector4d expected(u.x(), u.y(), u.z(), w.z());
          EXPECT_LT((decision.wanted.vector() - expected).norm(), 1e-12 * expected.norm() + 1e-13);
          EXPECT_EQ(decision.state, CommandState::Servo);
        }
      }
    }
  }
}

// Flown exactly, the wanted command moves what the levelled camera sees at L v_c, and of all
// commands it comes nearest to the rate -gain e.
TEST(Decide, MovesTheErrorAtTheRateOfTheLaw) {
  test::Random random("decide rate");
  const double h = 1e-5;
  for (const Mount& mount : kMounts) {
    for (int i = 0; i < 40; ++i) {
      Task task = test::example_task(mount);
      task.limits = kNoLimits;
      task.servo = {Law::Cur, Freedom::Four, 0.8};
      const Flight flight = random_flight(random);
      const Decision decision = decide_at(flight, task);
      ASSERT_TRUE(decision.servo);
      EXPECT_EQ(decision.command.vector(), decision.wanted.vector());
      const auto seen_after = [&](const VelocityCommand& command, double t) {
        return test::stacked(test::seen_from(flight.after(command, t).level_camera(mount),
                                             test::target_for(task), task));
      };
      const auto rate_of = [&](const VelocityCommand& command) -> Eigen::VectorXd {
        return (seen_after(command, h) - seen_after(command, -h)) / (2 * h);
      };
      const Eigen::VectorXd rate = rate_of(decision.command);
      const auto level = test::seen_from(flight.level_camera(mount), test::target_for(task), task);
      const Eigen::VectorXd expected =
          test::oracle_interaction(level).cast<double>() * decision.servo->twist.vector();
      // Differences of h^2 times third derivatives of order 1, rounding 1e-16 / h.
      EXPECT_LT((rate - expected).norm(), 1e-8);
      const Eigen::VectorXd left = rate + 0.8 * decision.servo->error;
      for (int k = 0; k < 4; ++k) {
        const VelocityCommand alone = VelocityCommand::from_vector(Vector4d::Unit(k));
        EXPECT_LT(std::abs(rate_of(alone).dot(left)), 1e-7);
      }
    }
  }
}

// Tilted all the time as a helicopter is in wind, the attitude known: it arrives from aside for
// each matrix and mount, and stays.
TEST(Decide, BringsTheHelicopterToItsGoal) {
  for (const Mount& mount : kMounts) {
    for (const Law law : kLaws) {
      Task task = test::example_task(mount);
      task.servo.law = law;
      const auto target = test::target_for(task);
      Flight flight{mount.rotation * Eigen::Vector3d(0.6, -0.4, -1), {0, 0, 0.2}};
      DecisionState state;
      for (int k = 0; k < 900; ++k) {
        const double t = k * kFrame;
        flight.attitude.roll = 0.15 * std::sin(2 * t);
        flight.attitude.pitch = 0.1 * std::cos(3 * t);
        const auto measured = test::seen_from(flight.camera(mount), target, task);
        const Decision decision = decide(measured, flight.attitude, t, state, task);
        EXPECT_EQ(decision.state, CommandState::Servo);
        flight = flight.after(decision.command, kFrame);
        state = decision.next;
      }
      // 30 s of gain 1, less what the limits take, leave e^-25 of a metre; what remains is the
      // lever arm of 0.3 m that swings with the tilt, followed with a lag: 0.15 rad at 3 rad/s.
      const Eigen::Vector3d goal = Flight{}.camera(mount).translation;
      EXPECT_LT((flight.camera(mount).translation - goal).norm(), 0.05) << name(law);
      EXPECT_LT(std::abs(flight.attitude.yaw), 0.02) << name(law);
    }
  }
}

// Every law of points flies it there, the learning ones on what the commands say of the motion.
TEST(Decide, ArrivesWithEveryLawOfPoints) {
  for (const Law law : {Law::CurZdes, Law::CurZarea, Law::CurZhomog, Law::MeanZdes, Law::Mjp,
                        Law::PmjR, Law::PmjT, Law::Lm, Law::Broyden, Law::Rls}) {
    Task task = test::example_task(kMounts[1]);
    task.servo.law = law;
    task.servo.smooth_start_per_s = 4;
    ASSERT_NO_THROW(task.check()) << name(law);
    const auto target = test::target_for(task);
    Flight flight{kMounts[1].rotation * Eigen::Vector3d(0.4, -0.3, -0.6), {0, 0, 0.2}};
    DecisionState state;
    for (int k = 0; k < 600; ++k) {
      const auto measured = test::seen_from(flight.camera(kMounts[1]), target, task);
      const Decision decision = decide(measured, flight.attitude, k * kFrame, state, task);
      ASSERT_EQ(decision.state, CommandState::Servo) << name(law) << name(decision.refusal) << k;
      flight = flight.after(decision.command, kFrame);
      state = decision.next;
    }
    // 20 s of gain 1, less the start and the limits: e^-15 of a metre; lm's slow modes 0.6 of it.
    const Eigen::Vector3d goal = Flight{}.camera(kMounts[1]).translation;
    EXPECT_LT((flight.camera(kMounts[1]).translation - goal).norm(), 0.01) << name(law);
  }
}

// The smooth start counts from the first answer, and again after hover.
TEST(Decide, StartsSmoothlyAfterEachHover) {
  Task task = test::example_task(kMounts[1]);
  task.servo.smooth_start_per_s = 4;
  const Flight flight{{0.3, 0.2, -0.2}, {0, 0, 0.1}};
  const auto measured = test::seen_from(flight.camera(kMounts[1]), test::target_for(task), task);
  DecisionState state;
  for (const double start_s : {0.0, 100.0}) {
    const Decision first = decide(measured, Attitude{}, start_s, state, task);
    EXPECT_LT(first.wanted.vector().norm(), 1e-14) << start_s;
    const Decision second = decide(measured, Attitude{}, start_s + 0.5, first.next, task);
    const Decision far = decide(measured, Attitude{}, start_s + 0.9, second.next, task);
    // The view has not changed: what is there is 1 - exp(-mu t) of the law.
    const double share = (1 - std::exp(-4 * 0.5)) / (1 - std::exp(-4 * 0.9));
    EXPECT_LT((second.wanted.vector() - share * far.wanted.vector()).norm(), 1e-13);
    EXPECT_GT(second.wanted.vector().norm(), 0.05);
    state = decide({}, Attitude{}, start_s + 50, far.next, task).next;  // long lost: hover
  }
}

TEST(Decide, SaysWhyTheLawRefuses) {
  const Task task = test::example_task(kMounts[1]);
  auto measured = test::seen_from(Flight{}.camera(kMounts[1]), test::target_for(task), task);
  EXPECT_EQ(decide(measured, Attitude{}, 1, {}, task).refusal, LawRefusal::None);
  EXPECT_EQ(decide({}, Attitude{}, 1, {}, task).refusal, LawRefusal::None);
  measured[1].depth_m = -1;
  EXPECT_EQ(decide(measured, Attitude{}, 1, {}, task).refusal, LawRefusal::Depth);
  measured.assign(4, measured[0]);
  EXPECT_EQ(decide(measured, Attitude{}, 1, {}, task).refusal, LawRefusal::Coincident);
}

// Without tilt it arrives exactly.
TEST(Decide, ArrivesExactlyWithoutTilt) {
  for (const Mount& mount : kMounts) {
    for (const Law law : kLaws) {
      Task task = test::example_task(mount);
      task.servo.law = law;
      const auto target = test::target_for(task);
      Flight flight{mount.rotation * Eigen::Vector3d(0.6, -0.4, -1), {0, 0, 0.2}};
      DecisionState state;
      for (int k = 0; k < 900; ++k) {
        const auto measured = test::seen_from(flight.camera(mount), target, task);
        const Decision decision = decide(measured, Attitude{}, k * kFrame, state, task);
        flight = flight.after(decision.command, kFrame);
        state = decision.next;
      }
      // 3 m of way at 1.5 m/s or less with gain 1: e^-20 m or less is left.
      EXPECT_LT(flight.ned.norm(), 1e-7) << name(law);
      EXPECT_LT(std::abs(flight.attitude.yaw), 1e-7) << name(law);
    }
  }
}

// With the attitude known a tilt is not answered: at the goal, about the camera, nothing is wanted.
TEST(Decide, DoesNotAnswerATilt) {
  for (const Mount& mount :
       {Mount{kMounts[0].rotation, {0, 0, 0}}, Mount{kMounts[1].rotation, {0, 0, 0}}}) {
    const Task task = test::example_task(mount);
    Flight flight;
    flight.attitude = {0.2, -0.15, 0};
    EXPECT_LT(decide_at(flight, task).wanted.vector().norm(), 1e-13);
    // Not known, it looks like being elsewhere.
    DecisionState state;
    state.stamp_s = 0;
    const auto measured = test::seen_from(flight.camera(mount), test::target_for(task), task);
    const Decision blind = decide(measured, std::nullopt, kFrame, state, task);
    EXPECT_GT(blind.wanted.vector().norm(), 0.1);
  }
}

// The signs a pilot would check on the ground: what it does when it is behind, left, above, turned.
TEST(Decide, GoesTheRightWay) {
  for (const Mount& mount : kMounts) {
    const Task task = test::example_task(mount);
    const auto wanted = [&](const Eigen::Vector3d& ned, double yaw) {
      return decide_at({ned, {0, 0, yaw}}, task).wanted;
    };
    EXPECT_GT(wanted({-0.3, 0, 0}, 0).forward_m_s, 0.1);
    EXPECT_GT(wanted({0, -0.3, 0}, 0).right_m_s, 0.05);
    EXPECT_GT(wanted({0, 0, -0.3}, 0).down_m_s, 0.1);
    EXPECT_LT(wanted({0, 0, 0}, 0.2).yaw_rate_rad_s, -0.1);
    EXPECT_LT(wanted({0.3, 0, 0}, 0).forward_m_s, -0.1);
  }
}

/// A run over which the target comes and goes.
class Loss : public testing::Test {
 protected:
  Decision frame(double stamp_s, const std::vector<Feature>& measured) {
    const Decision decision = decide(measured, Attitude{}, stamp_s, state_, task_);
    state_ = decision.next;
    return decision;
  }
  Decision seen(double stamp_s) { return frame(stamp_s, measured_); }
  Decision unseen(double stamp_s) { return frame(stamp_s, {}); }
  /// Seen for a second: in full flight at the last of the returned stamps.
  double take_off() {
    double stamp_s = 100;
    for (int k = 0; k <= 30; ++k) seen(stamp_s = 100 + k * kFrame);
    EXPECT_GT(state_.sent.vector().norm(), 0.5);
    return stamp_s;
  }
  void expect_hover(const Decision& decision) {
    EXPECT_EQ(decision.command.vector(), Vector4d::Zero());
    EXPECT_EQ(decision.state, CommandState::Hover);
    EXPECT_EQ(decision.next.sent.vector(), Vector4d::Zero());
  }

  const Task task_ = test::example_task(test::forward_camera());
  const Flight away_{{-1.5, 0.5, 0.3}, {}};
  const std::vector<Feature> measured_ =
      test::seen_from(away_.camera(task_.body_from_camera), test::target_for(task_), task_);
  DecisionState state_;
};

TEST_F(Loss, HoversBeforeTheTargetIsSeen) {
  for (int k = 0; k < 5; ++k) expect_hover(unseen(k * kFrame));
}

// No time has passed that could allow a change.
TEST_F(Loss, ChangesNothingInTheFirstFrame) {
  const Decision first = seen(5);
  EXPECT_EQ(first.state, CommandState::Servo);
  EXPECT_EQ(first.command.vector(), Vector4d::Zero());
  EXPECT_GT(first.wanted.vector().norm(), 0.1);
  EXPECT_GT(seen(5 + kFrame).command.vector().norm(), 0);
}

TEST_F(Loss, HoldsThenDecaysThenHovers) {
  const double last_s = take_off();
  const VelocityCommand last = state_.sent;
  for (int k = 1; k <= 45; ++k) {
    const double unseen_s = k * kFrame;
    const Decision decision = unseen(last_s + unseen_s);
    const Vector4d v = decision.command.vector();
    if (unseen_s < 0.1 - 1e-9) {
      EXPECT_EQ(v, last.vector());
      EXPECT_EQ(decision.state, CommandState::Hold);
    } else if (unseen_s > 0.1 + 1e-9 && unseen_s < 1 - 1e-9) {
      EXPECT_LT((v - std::exp(-(unseen_s - 0.1) / 0.4) * last.vector()).norm(), 1e-12);
      EXPECT_EQ(decision.state, CommandState::Decay);
    } else if (unseen_s > 1 + 1e-9) {
      expect_hover(decision);
    }
    EXPECT_FALSE(decision.servo);
  }
}

// The command goes on from where the decay has brought it, at the rate the limits allow.
TEST_F(Loss, ResumesWithoutAJump) {
  for (const int lost_frames : {1, 3, 10, 40}) {
    double stamp_s = take_off();
    for (int k = 0; k < lost_frames; ++k) unseen(stamp_s += kFrame);
    Vector4d before = state_.sent.vector();
    for (int k = 0; k < 30; ++k) {
      const Decision decision = seen(stamp_s += kFrame);
      EXPECT_EQ(decision.state, CommandState::Servo);
      const Vector4d change = (decision.command.vector() - before).cwiseAbs();
      const Vector4d allowed = task_.limits.acceleration.vector() * kFrame;
      EXPECT_LE((change - allowed).maxCoeff(), 1e-12) << lost_frames << ' ' << k;
      before = decision.command.vector();
    }
    state_ = {};
  }
}

// In sight, but with no answer: the same as not seen.
TEST_F(Loss, IsAlsoALawWithoutAnAnswer) {
  const double last_s = take_off();
  const VelocityCommand last = state_.sent;
  auto one_place = task_;  // and L there, not at the goal
  one_place.servo.law = Law::Cur;
  const Decision decision =
      decide(std::vector<Feature>(4, measured_[0]), Attitude{}, last_s + kFrame, state_, one_place);
  EXPECT_EQ(decision.state, CommandState::Hold);
  EXPECT_EQ(decision.command.vector(), last.vector());
  auto behind = measured_;
  for (Feature& f : behind) f.depth_m = -f.depth_m;
  EXPECT_EQ(frame(last_s + kFrame, behind).state, CommandState::Hold);
  EXPECT_EQ(frame(last_s + 2 * kFrame, {measured_[0], measured_[1]}).state, CommandState::Hold);
}

// A stamp that repeats, goes back or is no number tells nothing of the time since: hover, and a
// start as from the first frame.
TEST_F(Loss, HoversForAStampThatDoesNotIncrease) {
  for (const double step_s : {0.0, -kFrame, -1e6, kNan, kInf, -kInf}) {
    state_ = {};
    const double last_s = take_off();
    expect_hover(seen(last_s + step_s));
    expect_hover(unseen(last_s + kFrame));  // what was sent before is not resumed
    double stamp_s = last_s + kFrame;
    Vector4d before = Vector4d::Zero();
    for (int k = 0; k < 30; ++k) {
      const Decision decision = seen(stamp_s += kFrame);
      EXPECT_EQ(decision.state, CommandState::Servo);
      EXPECT_LE(((decision.command.vector() - before).cwiseAbs() -
                 task_.limits.acceleration.vector() * kFrame)
                    .maxCoeff(),
                1e-12);
      before = decision.command.vector();
    }
    EXPECT_GT(before.norm(), 0.5);
  }
}

// A clock set back for good must not ground the helicopter: one hover, then on with the new time.
// After nonsense the clock may be anywhere: no model is flown up to there.
TEST_F(Loss, StartsItsModelAnewAtOnceWhateverTheClockSays) {
  Task task = task_;
  task.timing.predict = Prediction::Commanded;
  DecisionState state;
  state.timing.latency_s = 0.1;
  std::vector<Feature> nonsense = measured_;
  nonsense[0].depth_m = std::nan("");
  state = decide(nonsense, {}, 1.7e9, state, task).next;
  state = decide(measured_, {}, 1.7e9 + 0.03, state, task).next;  // or it would take a day
  EXPECT_EQ(state.motion.stamp_s, 1.7e9 + 0.03);
  EXPECT_EQ(state.timing.latency_s, 0.1);
}

TEST_F(Loss, GoesOnWithAClockThatWasSetBack) {
  take_off();
  expect_hover(seen(3));
  for (int k = 1; k < 30; ++k) EXPECT_EQ(seen(3 + k * kFrame).state, CommandState::Servo);
  EXPECT_GT(state_.sent.vector().norm(), 0.5);
}

// After a long gap the helicopter has long stopped by the receiver's own watch; nothing may jump to
// full speed on one image.
TEST_F(Loss, StartsAnewAfterALongGap) {
  for (const double gap_s : {1.1, 10.0, 1e6, 1e300}) {
    state_ = {};
    double stamp_s = take_off();
    stamp_s += gap_s;
    EXPECT_EQ(seen(stamp_s).command.vector(), Vector4d::Zero()) << gap_s;
    state_ = {};
    stamp_s = take_off() + gap_s;
    expect_hover(unseen(stamp_s));
  }
  state_ = {};
  const double last_s = take_off();
  seen(last_s + 10);
  EXPECT_LE(seen(last_s + 10 + kFrame).command.forward_m_s,
            task_.limits.acceleration.forward_m_s * kFrame + 1e-12);
}

TEST_F(Loss, HoversAtOnceForNumbersThatAreNotFinite) {
  for (const double bad : {kNan, kInf, -kInf}) {
    for (const int field : {0, 1, 2}) {
      state_ = {};
      const double last_s = take_off();
      auto broken = measured_;
      (field == 0 ? broken[2].at.x : field == 1 ? broken[2].at.y : broken[2].depth_m) = bad;
      expect_hover(frame(last_s + kFrame, broken));
      expect_hover(unseen(last_s + 2 * kFrame));
      EXPECT_EQ(seen(last_s + 3 * kFrame).state, CommandState::Servo);
    }
    for (const Attitude& attitude :
         {Attitude{bad, 0, 0}, Attitude{0, bad, 0}, Attitude{0, 0, bad}}) {
      state_ = {};
      const double last_s = take_off();
      expect_hover(decide(measured_, attitude, last_s + kFrame, state_, task_));
    }
  }
}

// Whatever comes, what goes out is finite and within the limits, and grows no faster than allowed.
TEST_F(Loss, SendsOnlyWhatTheLimitsAllow) {
  test::Random random("decide anything");
  const double numbers[] = {0, -1, 1e-7, 0.3, 5, 1e9, 1e300, kNan, kInf, -kInf};
  double stamp_s = 0;
  int moving = 0;
  for (int k = 0; k < 5000; ++k) {
    auto measured = measured_;
    std::optional<Attitude> attitude = Attitude{};
    double step_s = kFrame;
    if (random.integer(0, 9) == 0) {
      const double number = numbers[random.integer(0, 9)];
      switch (random.integer(0, 5)) {
        case 0:
          measured.clear();
          break;
        case 1:
          measured[std::size_t(random.integer(0, 3))].at.x = number;
          break;
        case 2:
          measured[std::size_t(random.integer(0, 3))].depth_m = number;
          break;
        case 3:
          step_s = number;
          break;
        case 4:
          attitude->roll = number;
          break;
        case 5:
          attitude.reset();
          break;
      }
    }
    const double now_s = stamp_s + step_s;
    const Decision decision = decide(measured, attitude, now_s, state_, task_);
    const Vector4d v = decision.command.vector();
    ASSERT_TRUE(v.allFinite());
    ASSERT_LE((v.cwiseAbs() - task_.limits.speed.vector()).maxCoeff(), 1e-12);
    if (decision.state == CommandState::Servo && state_.stamp_s && step_s <= 1) {
      ASSERT_LE(
          ((v - state_.sent.vector()).cwiseAbs() - task_.limits.acceleration.vector() * step_s)
              .maxCoeff(),
          1e-12);
    }
    moving += v.norm() > 0.1;
    state_ = decision.next;
    if (std::isfinite(now_s) && std::abs(now_s) < 1e8) stamp_s = now_s;
  }
  EXPECT_GT(moving, 1000);
}

}  // namespace
}  // namespace kestrel

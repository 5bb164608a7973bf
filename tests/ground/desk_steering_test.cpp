// The part of GroundDesk in which a hand flies, and what it takes of law, limits and goal.
#include <gtest/gtest.h>

#include "ground/desk_viewer.hpp"

namespace kestrel {
namespace {

constexpr double kFresh_s = HeldSticks::kFresh_s;

/// A desk whose commander flies by hand; frames come at 30 Hz of its own clock.
class Steering : public test::Desk {
 protected:
  Answer take_sticks(double now_s) { return desk_.handle(asked(Ask::Grip, first_), now_s).answer; }

  Answer push(const VelocityCommand& wanted, double now_s) {
    GroundCommand sticks = asked(Ask::Sticks, first_);
    sticks.velocity = wanted;
    return desk_.handle(sticks, now_s).answer;
  }

  /// What a frame of the law at this time becomes, and what leaves the gate then.
  VelocityCommand frame(double now_s) {
    Decision law;
    law.command = law.wanted = {0, 0.3, 0, 0};
    law.state = CommandState::Servo;
    law.next.stamp_s = now_s;
    law.next.sent = law.command;
    const Decision flown = desk_.steered(law, before_, now_s);
    before_ = flown.next;
    EXPECT_EQ(flown.wanted.right_m_s, 0.3) << "what the law wants is always to be seen";
    gate_.send(flown.command, now_s);
    return written_.all.back();
  }

  Answer give(GroundCommand command) { return desk_.handle(command, 0).answer; }
  using Desk::give;

  DecisionState before_;
  const VelocityCommand kForward{0.4, 0, 0, 0};
};

TEST_F(Steering, AHandTakesTheVehicleFromTheLaw) {
  give(Ask::Start);
  frame(0);
  EXPECT_EQ(frame(0.03).right_m_s, 0.3);
  EXPECT_EQ(push(kForward, 0.04).kind, Answer::Kind::Refused) << "values without a hand";
  EXPECT_EQ(take_sticks(0.05).kind, Answer::Kind::Done);
  VelocityCommand sent;
  for (double t = 0.06; t < 1; t += 0.03) {
    push(kForward, t);
    sent = frame(t);
  }
  EXPECT_EQ(sent.vector(), kForward.vector());
  EXPECT_EQ(give(Ask::Start).kind, Answer::Kind::Refused) << "not from the hand to the law";
}

TEST_F(Steering, WhoLetsGoHoversUntilStart) {
  take_sticks(0);
  for (double t = 0.03; t < 0.5; t += 0.03) {
    push(kForward, t);
    frame(t);
  }
  desk_.handle(asked(Ask::Hover, ""), 0.5);
  EXPECT_TRUE(written_.all.back().vector().isZero(0)) << "without waiting for a frame";
  EXPECT_EQ(push(kForward, 0.51).kind, Answer::Kind::Refused)
      << "it was under way when the hand let go";
  EXPECT_TRUE(frame(0.52).vector().isZero(0));
  EXPECT_EQ(desk_.mode(), FlightMode::Hover);
  give(Ask::Start);
  frame(0.55);
  EXPECT_EQ(frame(0.58).right_m_s, 0.3);
}

TEST_F(Steering, SilentSticksAreZeroAtOnceWithoutAFrame) {
  give(Ask::Start);
  take_sticks(0);
  push(kForward, 0.1);
  frame(0.1);
  frame(0.2);
  desk_.look_after(0.1 + 0.99 * kFresh_s);
  EXPECT_EQ(desk_.mode(), FlightMode::Sticks);
  const std::size_t before = written_.all.size();
  desk_.look_after(0.1 + 1.01 * kFresh_s);
  EXPECT_EQ(desk_.mode(), FlightMode::Hover);
  ASSERT_EQ(written_.all.size(), before + 1);
  EXPECT_TRUE(written_.all.back().vector().isZero(0));
  EXPECT_EQ(push(kForward, 0.5).kind, Answer::Kind::Refused);
}

TEST_F(Steering, AFrameFindsSilentSticksByItself) {
  take_sticks(0);
  push(kForward, 0.1);
  for (double t = 0.11; t < 0.4; t += 0.03) frame(t);
  EXPECT_GT(written_.all.back().forward_m_s, 0);
  EXPECT_TRUE(frame(0.1 + 1.01 * kFresh_s).vector().isZero(0));
}

TEST_F(Steering, WhoLosesTheCommandLetsGo) {
  take_sticks(0);
  push(kForward, 0.1);
  EXPECT_EQ(desk_.handle(asked(Ask::Release, first_), 0.2).answer.kind, Answer::Kind::Done);
  EXPECT_EQ(desk_.mode(), FlightMode::Hover);
  desk_.handle(asked(Ask::Take, second_), 0.2);
  EXPECT_EQ(take_sticks(0.2).kind, Answer::Kind::Refused) << "only the commander takes them";
  EXPECT_EQ(push(kForward, 0.2).kind, Answer::Kind::Refused);
}

TEST_F(Steering, AnAbortTakesTheSticks) {
  take_sticks(0);
  push(kForward, 0.1);
  frame(0.1);
  desk_.handle(asked(Ask::Abort, "anybody"), 0.15);
  EXPECT_TRUE(written_.all.back().vector().isZero(0));
  EXPECT_EQ(take_sticks(0.2).kind, Answer::Kind::Refused);
  EXPECT_EQ(desk_.mode(), FlightMode::Aborted);
}

TEST_F(Steering, TheLawIsOneThatTheTaskMayFly) {
  const DeskStatus status = desk_.status();
  EXPECT_EQ(status.law, "mean");
  EXPECT_GE(status.laws.size(), 10u);
  GroundCommand law = asked(Ask::Law, first_);
  law.law = "autopilot";
  EXPECT_EQ(give(law).kind, Answer::Kind::Refused);
  EXPECT_FALSE(desk_.course());
  for (const std::string& word : status.laws) {
    law = asked(Ask::Law, first_);
    law.law = word;
    EXPECT_EQ(give(law).kind, Answer::Kind::Done) << word;
    EXPECT_EQ(name(desk_.course()->task.servo.law), word);
  }
}

TEST_F(Steering, TheLimitsAreNeverAboveTheTasks) {
  GroundCommand limits = asked(Ask::Limits, first_);
  const Eigen::Vector4d most = task_.limits.speed.vector();
  for (int i = 0; i < 4; ++i) {
    limits = asked(Ask::Limits, first_);
    Eigen::Vector4d above = most / 2;
    above[i] = most[i] * 1.01;
    limits.velocity = VelocityCommand::from_vector(above);
    const Answer answer = give(limits);
    EXPECT_EQ(answer.kind, Answer::Kind::Refused) << i;
    EXPECT_NE(answer.words.find("at most"), std::string::npos) << answer.words;
  }
  EXPECT_FALSE(desk_.course());
  limits = asked(Ask::Limits, first_);
  limits.velocity = VelocityCommand::from_vector(most / 2);
  EXPECT_EQ(give(limits).kind, Answer::Kind::Done);
  EXPECT_EQ(desk_.course()->task.limits.speed.vector(), most / 2);
  limits = asked(Ask::Limits, first_);
  limits.velocity = VelocityCommand::from_vector(most);
  EXPECT_EQ(give(limits).kind, Answer::Kind::Done) << "and back up to the task's";
  // And the sticks keep to them.
  take_sticks(0);
  for (double t = 0.03; t < 3; t += 0.03) {
    push({1e6, 0, 0, 0}, t);
    frame(t);
  }
  EXPECT_EQ(written_.all.back().forward_m_s, most[0]);
}

TEST_F(Steering, AGoalByNumbersIsWhereTheVehicleWillBe) {
  const LevelTarget level = level_from_target(task_.goal, task_.body_from_camera);
  GroundCommand goal = asked(Ask::Goal, first_);
  goal.goal = VehiclePlace{{-2.5, 0.2, -0.1}, 0.05};
  ASSERT_EQ(give(goal).kind, Answer::Kind::Done);
  const VehiclePlace place =
      vehicle_place(desk_.course()->task.goal, task_.body_from_camera, level);
  EXPECT_LT((place.position_m - goal.goal->position_m).norm(), 1e-9);
  EXPECT_NEAR(place.yaw_rad, 0.05, 1e-9);
}

TEST_F(Steering, AGoalThatShowsNoTargetIsRefused) {
  for (const VehiclePlace& place : {VehiclePlace{{2.5, 0, 0}, 0}, VehiclePlace{{-2.5, 0, 0}, 3},
                                    VehiclePlace{{-2.5, 0, 0}, 0.5}, VehiclePlace{{-0.1, 0, 0}, 0},
                                    VehiclePlace{{-2.5, 40, 0}, 0}}) {
    GroundCommand goal = asked(Ask::Goal, first_);
    goal.goal = place;
    EXPECT_EQ(give(goal).kind, Answer::Kind::Refused) << place.position_m.transpose();
    EXPECT_FALSE(desk_.course());
  }
}

}  // namespace
}  // namespace kestrel

#include "kestrel/lab/law_replay.hpp"

#include <gtest/gtest.h>

#include "lab/feature_flight.hpp"

namespace kestrel {
namespace {

test::Truth noisy() {
  test::Truth truth;
  truth.noise_px = 0.3;
  return truth;
}

TEST(LawReplay, TheRunsOwnLawWantsWhatItWanted) {
  Task task = test::square_task();
  task.limits = CommandLimits{};
  const LogFile log = test::feature_flight(task, noisy(), 8);
  const LawReplay replay = replayed(log, task, task.servo.law);
  ASSERT_EQ(replay.frames.size(), log.rows.size());
  for (std::size_t i = 0; i < log.rows.size(); ++i) {
    ASSERT_TRUE(replay.frames[i].wanted);
    // Rounding of the logged rotation vector, times the condition of the task (600).
    EXPECT_LT((replay.frames[i].wanted->vector() - log.rows[i].decision->wanted.vector()).norm(),
              1e-9);
    EXPECT_LT((replay.frames[i].sent.vector() - log.rows[i].decision->sent.vector()).norm(), 1e-9);
  }
  const ReplayDifference d = difference(replay, log);
  EXPECT_EQ(d.answered, int(log.rows.size()));
  EXPECT_LT(d.largest_m_s.value(), 1e-9);
}

// At the first frame, 4 m behind the goal at nearly twice its distance, `cur` wants more speed than
// `des` by about the square of the ratio of the depths (9/5)^2.
TEST(LawReplay, AnotherLawWantsItsOwn) {
  const Task task = test::square_task();
  const LogFile log = test::feature_flight(task, {}, 5);
  const double cur = replayed(log, task, Law::Cur).frames[0].wanted->forward_m_s;
  const double des = replayed(log, task, Law::Des).frames[0].wanted->forward_m_s;
  EXPECT_NEAR(cur / des, 81. / 25, 0.6);
  EXPECT_GT(difference(replayed(log, task, Law::Des), log).largest_m_s.value(), 0.1);
}

TEST(LawReplay, EveryLawAnswersOrSaysWhyNot) {
  const Task task = test::square_task();
  const LogFile log = test::feature_flight(task, noisy(), 3);
  for (const Law law : all_laws()) {
    const LawReplay replay = replayed(log, task, law);
    for (const ReplayedFrame& frame : replay.frames) {
      EXPECT_NE(frame.wanted.has_value(), frame.refusal != LawRefusal::None) << name(law);
      EXPECT_TRUE(!frame.wanted || is_finite(*frame.wanted)) << name(law);
    }
  }
}

TEST(LawReplay, FramesWithoutTheTargetHaveNoWish) {
  const Task task = test::square_task();
  LogFile log = test::feature_flight(task, noisy(), 3);
  for (std::size_t i = 30; i < 80; ++i) {
    log.rows[i].servo.reset();
    log.rows[i].pose.reset();
  }
  const LawReplay replay = replayed(log, task, Law::Cur);
  EXPECT_FALSE(replay.frames[40].wanted);
  EXPECT_EQ(replay.frames[40].refusal, LawRefusal::None);
  // Hover once a second has gone: 30 frames.
  EXPECT_EQ(replay.frames[75].sent.vector(), VelocityCommand::hover().vector());
  EXPECT_EQ(difference(replay, log).answered, int(log.rows.size()) - 50);
  EXPECT_FALSE(difference(LawReplay{}, log).median_m_s);
}

}  // namespace
}  // namespace kestrel

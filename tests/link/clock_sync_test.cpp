#include "kestrel/link/clock_sync.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

/// A vehicle whose clock runs `offset_s` ahead of ours, at the end of a line.
struct Peer {
  double offset_s = 0;
  double drift = 0;

  double clock(double ours_s) const { return ours_s * (1 + drift) + offset_s; }

  /// Asks and is answered: delays of the way there and of the way back. When it arrives.
  ClockAnswer exchange(ClockSync& sync, double at_s, double there_s, double back_s) const {
    const mavlink::TimeSync question = sync.ask(at_s);
    EXPECT_EQ(question.tc1_ns, 0);
    const auto answer = time_answer(question, 1, 1, clock(at_s + there_s));
    return sync.take(*answer, at_s + there_s + back_s);
  }
};

TEST(ClockSync, KnowsNothingBeforeAnAnswer) {
  ClockSync sync;
  EXPECT_FALSE(sync.estimate(0));
  sync.ask(0);
  EXPECT_FALSE(sync.estimate(0.1));
}

TEST(ClockSync, FindsTheOffsetOfASymmetricLine) {
  for (const double offset_s : {-12345.678, 0.25, 987654.321}) {
    ClockSync sync;
    EXPECT_EQ((Peer{offset_s}.exchange(sync, 100, 0.02, 0.02)), ClockAnswer::Used);
    const auto estimate = sync.estimate(100.04);
    ASSERT_TRUE(estimate);
    EXPECT_NEAR(estimate->offset_s, offset_s, 1e-8);  // nanoseconds on the wire
    EXPECT_NEAR(estimate->round_trip_s, 0.04, 1e-8);
    EXPECT_NEAR(estimate->to_theirs(estimate->to_ours(5)), 5, 1e-9);
    EXPECT_NEAR(estimate->to_ours(offset_s + 7), 7, 1e-7);
  }
}

// Delays of 1 to 100 ms either way, each way its own, clocks that part by 60 ppm: the truth is
// always within the bound, and of many exchanges the best is far better than the worst.
TEST(ClockSync, TheTruthIsWithinTheBoundHoweverTheLineJitters) {
  test::Random random("clock sync");
  for (int run = 0; run < 50; ++run) {
    Peer peer{random.uniform(-1e4, 1e4), random.uniform(-60e-6, 60e-6)};
    ClockSync sync;
    double worst_s = 0;
    for (int i = 0; i < 200; ++i) {
      const double now_s = i * 0.2;
      const double there_s = 0.001 + 0.02 * -std::log(random.uniform(1e-3, 1));
      const double back_s = 0.001 + 0.02 * -std::log(random.uniform(1e-3, 1));
      ASSERT_EQ(peer.exchange(sync, now_s, there_s, back_s), ClockAnswer::Used);
      worst_s = std::max(worst_s, std::abs(there_s - back_s) / 2);
      const double later_s = now_s + there_s + back_s;
      const auto estimate = sync.estimate(later_s);
      const double truth_s = peer.clock(later_s) - later_s;
      ASSERT_LE(std::abs(estimate->offset_s - truth_s), estimate->error_s + 1e-6);
    }
    const double end_s = 40.0;
    EXPECT_LT(sync.estimate(end_s)->error_s, worst_s / 2);
    EXPECT_EQ(sync.jumps(), 0);
  }
}

TEST(ClockSync, IgnoresAnswersToWhatItNeverAskedAndSecondAnswers) {
  ClockSync sync;
  const mavlink::TimeSync question = sync.ask(10);
  EXPECT_EQ(sync.take({5000000000, question.ts1_ns + 1, 0, 0}, 10.01), ClockAnswer::NotAsked);
  EXPECT_EQ(sync.take({0, question.ts1_ns, 0, 0}, 10.01), ClockAnswer::NotAsked);  // a question
  EXPECT_FALSE(sync.estimate(10.01));
  EXPECT_EQ(sync.take({5000000000, question.ts1_ns, 0, 0}, 10.01), ClockAnswer::Used);
  EXPECT_EQ(sync.take({9000000000, question.ts1_ns, 0, 0}, 10.02), ClockAnswer::NotAsked);
  EXPECT_NEAR(sync.estimate(10.02)->offset_s, 5 - 10.005, 1e-8);
}

TEST(ClockSync, DoesNotUseAnAnswerThatComesTooLateOrBeforeItsQuestion) {
  ClockSync sync;
  EXPECT_EQ((Peer{3}.exchange(sync, 10, 1, 1.5)), ClockAnswer::NotAsked);
  const mavlink::TimeSync question = sync.ask(20);
  EXPECT_EQ(sync.take({5000000000, question.ts1_ns, 0, 0}, 19), ClockAnswer::NotAsked);
  EXPECT_FALSE(sync.estimate(20));
}

TEST(ClockSync, NoticesThatTheVehicleHasRestarted) {
  ClockSync sync;
  Peer peer{1000};
  for (int i = 0; i < 10; ++i) peer.exchange(sync, i, 0.01, 0.01);
  peer.offset_s = -10;  // its clock starts anew
  EXPECT_EQ(peer.exchange(sync, 10, 0.01, 0.01), ClockAnswer::Jumped);
  EXPECT_EQ(sync.jumps(), 1);
  EXPECT_NEAR(sync.estimate(10.02)->offset_s, -10, 1e-6);
  EXPECT_EQ(peer.exchange(sync, 11, 0.01, 0.01), ClockAnswer::Used);
  EXPECT_EQ(sync.jumps(), 1);
}

TEST(ClockSync, ForgetsWhatIsTooOldAndGrowsWithoutBoundNowhere) {
  ClockSync sync;
  Peer{7}.exchange(sync, 10, 0.01, 0.01);
  EXPECT_TRUE(sync.estimate(40));
  EXPECT_FALSE(sync.estimate(40.1));
  for (int i = 0; i < 10000; ++i) sync.ask(50 + i * 0.001);
  const mavlink::TimeSync first{8000000000, 50000000000, 0, 0};
  EXPECT_EQ(sync.take(first, 60), ClockAnswer::NotAsked);  // given up
}

TEST(TimeAnswer, MirrorsTheQuestionOfWhoAsksUs) {
  const auto answer = time_answer({0, 42, 0, 0}, 1, 191, 3.5);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->tc1_ns, 3500000000);
  EXPECT_EQ(answer->ts1_ns, 42);
  EXPECT_TRUE(time_answer({0, 42, 1, 191}, 1, 191, 3.5));
  EXPECT_FALSE(time_answer({0, 42, 2, 191}, 1, 191, 3.5));
  EXPECT_FALSE(time_answer({0, 42, 1, 1}, 1, 191, 3.5));
  EXPECT_FALSE(time_answer({7, 42, 0, 0}, 1, 191, 3.5));  // an answer
}

TEST(ClockSyncOptions, NameWhatIsOutOfRange) {
  for (const double bad :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    ClockSyncOptions options;
    options.window_s = bad;
    EXPECT_THROW(ClockSync{options}, std::invalid_argument);
    options = {};
    options.patience_s = bad;
    EXPECT_THROW(ClockSync{options}, std::invalid_argument);
    options = {};
    options.drift_s_per_s = bad;
    EXPECT_THROW(ClockSync{options}, std::invalid_argument);
  }
}

}  // namespace
}  // namespace kestrel

#include "kestrel/eval/bench_pictures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/made_up.hpp"

namespace kestrel {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<FrameScore> scores(const std::vector<double>& errors_px) {
  std::vector<FrameScore> list;
  for (const double error : errors_px) {
    list.push_back(
        {std::int64_t(list.size()), error < 0 ? std::nullopt : std::optional<double>(error)});
  }
  return list;
}

TEST(WorstFrames, WrongIsWorseThanLostIsWorseThanRough) {
  EXPECT_THAT(worst_frames(scores({0, 5, -1, 30, 1}), 9, 2), ElementsAre(3, 2, 1));
  EXPECT_THAT(worst_frames(scores({0, 5, -1, 30, 1}), 2, 2), ElementsAre(3, 2));
  EXPECT_TRUE(worst_frames(scores({0, 1, 2}), 9, 2).empty());
  EXPECT_TRUE(worst_frames({}, 9, 2).empty());
}

TEST(WorstFrames, EachStandsForItsNeighbours) {
  std::vector<double> errors(100, 0);
  for (std::size_t i = 40; i < 50; ++i) errors[i] = 50 + double(i);  // one bad stretch
  errors[90] = 20;
  // A twentieth of 100 frames is 5: 49, then 44, then the other place.
  EXPECT_THAT(worst_frames(scores(errors), 3, 2), ElementsAre(49, 44, 90));
}

TEST(WorstPictures, ShowTheFramesThatWereBad) {
  const BenchSequence sequence = test::made_up_sequence("s", 6);
  std::vector<BenchRun> runs{test::made_up_run(sequence, 0), test::made_up_run(sequence, 0)};
  runs[1].frames[2].answer = test::answer_at(40);
  runs[1].frames[4].answer = {};
  runs[1].frames[4].answer.state = "lost";
  const auto pictures = worst_pictures(sequence, runs, 3);
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_TRUE(pictures[0].empty());
  ASSERT_EQ(pictures[1].size(), 2u);
  EXPECT_EQ(pictures[1][0].caption, "frame 2: 38.0 px off");
  EXPECT_EQ(pictures[1][1].caption, "frame 4: not found (lost)");
  EXPECT_EQ(pictures[1][0].width_px, 80);
}

TEST(WorstPictures, AreNoneWhenTheFramesAreGone) {
  BenchSequence sequence = test::made_up_sequence("s", 6);
  const std::vector<BenchRun> runs{test::made_up_run(sequence, 30)};
  sequence.open = []() -> std::unique_ptr<FrameSource> { throw std::runtime_error("gone"); };
  const auto pictures = worst_pictures(sequence, runs, 3);
  ASSERT_EQ(pictures.size(), 1u);
  EXPECT_TRUE(pictures[0].empty());
}

}  // namespace
}  // namespace kestrel

#include "kestrel/link/sequence.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

TEST(Sequence, LosesNothingInARowFromAnyStart) {
  for (int start = 0; start < 256; ++start) {
    SequenceWindow window;
    for (int i = 0; i < 600; ++i) EXPECT_EQ(window.arrive(std::uint8_t(start + i)), Arrival::New);
    EXPECT_EQ(window.lost(), 0);
  }
}

TEST(Sequence, CountsEachGapAlsoAcrossTheWrap) {
  for (int start : {0, 100, 200, 250, 255}) {
    for (int gap = 0; gap <= 191; ++gap) {
      SequenceWindow window;
      window.arrive(std::uint8_t(start));
      EXPECT_EQ(window.arrive(std::uint8_t(start + 1 + gap)), Arrival::New);
      EXPECT_EQ(window.lost(), gap);
    }
  }
}

TEST(Sequence, KnowsWhatWasHereBefore) {
  SequenceWindow window;
  for (int i = 0; i < 300; ++i) {
    window.arrive(std::uint8_t(i));
    for (int back = 0; back <= std::min(i, 63); ++back) {
      EXPECT_EQ(window.arrive(std::uint8_t(i - back)), Arrival::Duplicate);
    }
  }
  EXPECT_EQ(window.lost(), 0);
}

TEST(Sequence, FrameBeforeTheFirstIsLateAndWasNotLost) {
  SequenceWindow window;
  window.arrive(2);
  EXPECT_EQ(window.arrive(255), Arrival::Late);
  EXPECT_EQ(window.arrive(255), Arrival::Duplicate);
  EXPECT_EQ(window.lost(), 0);
}

TEST(Sequence, AfterALongGapTheNumbersOfItMayStillComeLate) {
  for (int gap = 63; gap <= 191; ++gap) {
    SequenceWindow window;
    for (int i = 0; i < 64; ++i) window.arrive(std::uint8_t(i));
    EXPECT_EQ(window.arrive(std::uint8_t(64 + gap)), Arrival::New);
    for (int back = 1; back <= 63; ++back) {
      EXPECT_EQ(window.arrive(std::uint8_t(64 + gap - back)), Arrival::Late);
      EXPECT_EQ(window.lost(), gap - back);
    }
  }
}

TEST(Sequence, AgreesWithTheTruthUnderLossReorderAndDuplication) {
  test::Random random("sequence");
  for (int run = 0; run < 50; ++run) {
    // Each frame is delayed by up to 20 places, lost one time in five, doubled one in ten.
    std::vector<std::pair<double, int>> arrivals;
    for (int i = 0; i < 2000; ++i) {
      if (i > 0 && random.integer(0, 4) == 0) continue;
      arrivals.emplace_back(i + random.uniform(0, i == 0 ? 1e-9 : 20), i);
      if (random.integer(0, 9) == 0) arrivals.emplace_back(i + random.uniform(0, 20), i);
    }
    std::sort(arrivals.begin(), arrivals.end());
    SequenceWindow window;
    std::set<int> seen;
    int newest = -1;
    for (const auto& [time, number] : arrivals) {
      const Arrival truth = seen.count(number) > 0 ? Arrival::Duplicate
                            : number > newest      ? Arrival::New
                                                   : Arrival::Late;
      ASSERT_EQ(window.arrive(std::uint8_t(number)), truth);
      seen.insert(number);
      newest = std::max(newest, number);
    }
    EXPECT_EQ(window.lost(), newest + 1 - long(seen.size()));
  }
}

}  // namespace
}  // namespace kestrel

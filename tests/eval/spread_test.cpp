#include "kestrel/eval/spread.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

TEST(Spread, OfNothingIsNothing) { EXPECT_FALSE(spread_of({})); }

TEST(Spread, OfOneNumberIsThatNumber) {
  const auto spread = spread_of({3.5});
  ASSERT_TRUE(spread);
  EXPECT_EQ(spread->count, 1);
  for (const double value : {spread->mean, spread->median, spread->p95, spread->max})
    EXPECT_EQ(value, 3.5);
}

TEST(Spread, ReadsOffKnownLists) {
  const auto even = spread_of({4, 1, 3, 2});
  EXPECT_EQ(even->mean, 2.5);
  EXPECT_EQ(even->median, 2.5);
  EXPECT_EQ(even->max, 4);
  EXPECT_EQ(spread_of({9, 1, 2})->median, 2);
  std::vector<double> hundred;
  for (int i = 100; i > 0; --i) hundred.push_back(i);
  EXPECT_EQ(spread_of(hundred)->p95, 95);
  hundred.push_back(101);
  EXPECT_EQ(spread_of(hundred)->p95, 96);  // 95 of 101 are less than 95 %
}

TEST(Spread, NinetyFivePercentDoNotExceedTheirPointAndFewerTheNumberBefore) {
  test::Random random("spread");
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> numbers;
    for (int i = 0; i < 1 + trial; ++i) numbers.push_back(random.uniform(0, 10));
    const double p95 = spread_of(numbers)->p95;
    const auto within = [&](auto beyond) {
      return double(std::count_if(numbers.begin(), numbers.end(), beyond)) / double(numbers.size());
    };
    EXPECT_GE(within([&](double x) { return x <= p95; }), 0.95);
    EXPECT_LT(within([&](double x) { return x < p95; }), 0.95);
  }
}

TEST(Spread, KeepsAnInfiniteNumberAtTheEnd) {
  const auto spread = spread_of({1, std::numeric_limits<double>::infinity(), 2});
  EXPECT_EQ(spread->median, 2);
  EXPECT_EQ(spread->max, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace kestrel

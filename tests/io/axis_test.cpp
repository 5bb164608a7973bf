#include "kestrel/io/axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInf = std::numeric_limits<double>::infinity();

TEST(Axis, MapsItsEndsAndKeepsOrder) {
  test::Random random("axis");
  for (int i = 0; i < 200; ++i) {
    const double low = random.uniform(-5, 5);
    const Axis axis{{low, low + random.uniform(0.1, 9)}, Spacing::Linear, 300, 40};
    EXPECT_NEAR(axis.at(axis.range.low), 300, 1e-9);
    EXPECT_NEAR(axis.at(axis.range.high), 40, 1e-9);
    const double a = random.uniform(-5, 5);
    EXPECT_GT(axis.at(a), axis.at(a + 0.01));  // this one grows towards smaller pixels
  }
}

TEST(Axis, LogarithmicSpacesDecadesEvenly) {
  const Axis axis{{0.01, 100}, Spacing::Logarithmic, 0, 400};
  for (int decade = 0; decade <= 4; ++decade)
    EXPECT_NEAR(axis.at(0.01 * std::pow(10, decade)), 100 * decade, 1e-9);
  EXPECT_FALSE(std::isfinite(axis.at(0)));
  EXPECT_FALSE(std::isfinite(axis.at(-1)));
  EXPECT_FALSE(std::isfinite(axis.at(kNan)));
}

TEST(RangeOf, HoldsAllValuesWithTheMargin) {
  const Range range = range_of({3, kNan, -1, kInf}, Spacing::Linear, 0.25);
  EXPECT_DOUBLE_EQ(range.low, -2);
  EXPECT_DOUBLE_EQ(range.high, 4);
}

TEST(RangeOf, IsAlwaysARange) {
  for (const auto& values : std::vector<std::vector<double>>{{},
                                                             {kNan, kInf},
                                                             {0},
                                                             {7, 7, 7},
                                                             {-1e-300, -1e-300},
                                                             {1e308, -1e308},
                                                             {5e-324, 1.7e308},
                                                             {-3, 0}})
    for (const Spacing spacing : {Spacing::Linear, Spacing::Logarithmic}) {
      const Range range = range_of(values, spacing, 0.1);
      EXPECT_LT(range.low, range.high);
      EXPECT_TRUE(std::isfinite(range.high - range.low));
      EXPECT_TRUE(spacing == Spacing::Linear || range.low > 0);
      const auto marks = ticks(range, spacing, 6);
      EXPECT_LE(marks.size(), 101u);
    }
}

TEST(Ticks, AreRoundEvenAndInside) {
  test::Random random("ticks");
  for (int i = 0; i < 500; ++i) {
    const double low = random.uniform(-1, 1) * std::pow(10, random.integer(-6, 6));
    const Range range{low, low + random.uniform(0.1, 1) * std::pow(10, random.integer(-6, 6))};
    const auto marks = ticks(range, Spacing::Linear, 6);
    // The step is at most sqrt(2.5) times more or less than the sixth asked for.
    ASSERT_GE(marks.size(), 3u);
    EXPECT_LE(marks.size(), 10u);
    const double step = marks[1].value - marks[0].value;
    const double power = std::pow(10, std::floor(std::log10(step) + 1e-6));
    const double mantissa = step / power;
    EXPECT_LT(std::min({std::abs(mantissa - 1), std::abs(mantissa - 2), std::abs(mantissa - 5)}),
              1e-5 * std::max(1., std::abs(low) / step));
    const double slack = 1e-8 * step;
    for (const Tick& mark : marks) {
      EXPECT_GE(mark.value, range.low - slack);
      EXPECT_LE(mark.value, range.high + slack);
    }
  }
}

TEST(Ticks, OfNoRangeAreNone) {
  for (const Range& range :
       {Range{1, 1}, Range{2, 1}, Range{kNan, 1}, Range{0, kInf}, Range{kNan, kNan}})
    for (const Spacing spacing : {Spacing::Linear, Spacing::Logarithmic})
      EXPECT_TRUE(ticks(range, spacing, 6).empty());
  EXPECT_TRUE(ticks({-1, 1}, Spacing::Logarithmic, 6).empty());
}

TEST(Ticks, SayTheirValue) {
  for (const Tick& mark : ticks({-0.35, 0.35}, Spacing::Linear, 7))
    EXPECT_NEAR(std::stod(mark.label), mark.value, 1e-12);
  EXPECT_EQ(ticks({-1, 1}, Spacing::Linear, 2)[1].label, "0");
  EXPECT_EQ(ticks({-3.8, 1.4}, Spacing::Linear, 5).size(), 5u);  // -3 .. 1
}

TEST(Ticks, LogarithmicArePowersOfTen) {
  const auto marks = ticks({2e-6, 3e2}, Spacing::Logarithmic, 10);
  ASSERT_EQ(marks.size(), 8u);  // 1e-5 .. 1e2
  EXPECT_EQ(marks.front().label, "10⁻⁵");
  EXPECT_EQ(marks.back().label, "100");
  for (const Tick& mark : marks)
    EXPECT_NEAR(std::log10(mark.value), std::round(std::log10(mark.value)), 1e-9);
}

}  // namespace
}  // namespace kestrel

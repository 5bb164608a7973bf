#include "kestrel/io/svg_bars.hpp"

#include <cmath>
#include <limits>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/markup_check.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const double kNan = std::numeric_limits<double>::quiet_NaN();

struct Box {
  double x;
  double width;
};

std::vector<Box> boxes(const std::string& svg) {
  std::vector<Box> out;
  const std::regex box("<rect class=\"b\\d\" x=\"([0-9.]+)\"[^>]*width=\"([0-9.]+)\"");
  for (std::sregex_iterator b(svg.begin(), svg.end(), box), end; b != end; ++b)
    out.push_back({std::stod((*b)[1]), std::stod((*b)[2])});
  return out;
}

BarChart chart_of(const std::vector<double>& values) {
  BarChart chart;
  chart.title = "a < b";
  chart.value_label = "m";
  for (const double value : values) chart.bars.push_back({"law & <1>", value});
  return chart;
}

TEST(SvgBars, LengthsAreAsTheValues) {
  const auto at = boxes(svg_bars(chart_of({1, 2, 0.5})));
  ASSERT_EQ(at.size(), 3u);
  EXPECT_NEAR(at[1].width / at[0].width, 2, 0.01);  // 0.05 px of rounding in some 100 px
  EXPECT_NEAR(at[2].width / at[0].width, 0.5, 0.01);
  EXPECT_EQ(at[0].x, at[1].x);
}

TEST(SvgBars, NegativeOnesGoToTheOtherSideOfZero) {
  const auto at = boxes(svg_bars(chart_of({1, -1})));
  ASSERT_EQ(at.size(), 2u);
  EXPECT_NEAR(at[1].x + at[1].width, at[0].x, 0.2);
  EXPECT_NEAR(at[1].width, at[0].width, 0.2);
}

TEST(SvgBars, AnIntervalSpansItsEnds) {
  BarChart chart = chart_of({0.5});
  chart.bars[0].low = 0.25;
  chart.bars[0].high = 0.75;
  const std::string svg = svg_bars(chart);
  std::smatch found;
  ASSERT_TRUE(std::regex_search(svg, found, std::regex("d=\"M([0-9.]+) [0-9.]+v8m0 -4H([0-9.]+)")));
  const Box bar = boxes(svg).at(0);
  EXPECT_NEAR(std::stod(found[1]), bar.x + bar.width / 2, 0.2);
  EXPECT_NEAR(std::stod(found[2]), bar.x + bar.width * 1.5, 0.2);
}

TEST(SvgBars, WritesTheValueOrTheNote) {
  BarChart chart = chart_of({0.12345, kNan, 3});
  chart.bars[2].note = "collision";
  const std::string svg = svg_bars(chart);
  EXPECT_THAT(svg, HasSubstr(">0.123<"));
  EXPECT_THAT(svg, HasSubstr(">–<"));
  EXPECT_THAT(svg, HasSubstr(">collision<"));
  EXPECT_THAT(svg, Not(HasSubstr(">3<")));
  EXPECT_EQ(boxes(svg).size(), 2u);
}

TEST(SvgBars, IsWellFormedForAnyNumbers) {
  for (const auto& values : std::vector<std::vector<double>>{
           {}, {kNan}, {0, 0}, {1e308, -1e308}, {1 / 0., -1 / 0.}, {5e-324}, {-3}}) {
    const std::string svg = svg_bars(chart_of(values));
    EXPECT_EQ(test::markup_fault(svg), "");
    EXPECT_FALSE(std::regex_search(svg, std::regex("=\"-?(nan|inf)"))) << svg;
  }
  EXPECT_THAT(svg_bars(chart_of({})), HasSubstr("no values to show"));
}

}  // namespace
}  // namespace kestrel

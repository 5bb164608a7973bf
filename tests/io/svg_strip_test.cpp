#include "kestrel/io/svg_strip.hpp"

#include <limits>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/markup_check.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

struct Bar {
  double x;
  double y;
  double width;
};

std::vector<Bar> bars(const std::string& svg) {
  std::vector<Bar> out;
  const std::regex bar("class=\"b[0-9]\" x=\"([0-9.]+)\" y=\"([0-9.]+)\" width=\"([0-9.]+)\"");
  for (std::sregex_iterator b(svg.begin(), svg.end(), bar), end; b != end; ++b)
    out.push_back({std::stod((*b)[1]), std::stod((*b)[2]), std::stod((*b)[3])});
  return out;
}

TEST(SvgStrip, BarsCoverTheRunOnce) {
  const Strip strip{
      "state", "time (s)", {"servo", "hold"}, {0, 1, 2, 3}, {"servo", "servo", "hold", "servo"}};
  const std::string svg = svg_strip(strip);
  const auto drawn = bars(svg);
  ASSERT_EQ(drawn.size(), 3u);  // servo twice, hold once
  const double second = drawn[0].width / 2;
  EXPECT_NEAR(drawn[1].width, second, 0.15);
  EXPECT_NEAR(drawn[2].width, second, 0.15);
  EXPECT_NEAR(drawn[2].x, drawn[0].x + drawn[0].width, 0.15);  // hold begins where servo ends
  EXPECT_EQ(drawn[0].y, drawn[1].y);
  EXPECT_GT(drawn[2].y, drawn[0].y);
  EXPECT_THAT(svg, HasSubstr("75.0 %"));
  EXPECT_THAT(svg, HasSubstr("25.0 %"));
  EXPECT_EQ(test::markup_fault(svg), "");
}

TEST(SvgStrip, TakesAnything) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(svg_strip({}), HasSubstr("no values"));
  for (const Strip& strip :
       {Strip{}, Strip{"a & b", "x", {"<one>"}, {5}, {"<one>"}},
        Strip{"t", "x", {"one"}, {nan, nan}, {"one", "two"}},
        Strip{"t", "x", {"one"}, {0, 1, 2}, {"one"}}, Strip{"t", "x", {}, {0}, {"one"}}}) {
    const std::string svg = svg_strip(strip);
    EXPECT_EQ(test::markup_fault(svg), "");
    EXPECT_FALSE(std::regex_search(svg, std::regex("=\"-?(nan|inf)"))) << svg;
  }
}

}  // namespace
}  // namespace kestrel

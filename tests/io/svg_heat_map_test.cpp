#include "kestrel/io/svg_heat_map.hpp"

#include <limits>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/markup_check.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

HeatMap example() {
  HeatMap map;
  map.title = "k < \"1\"";
  map.x_label = "depth factor";
  map.y_label = "noise (px)";
  map.value_label = "steps";
  map.x = {"0.5", "1", "2"};
  map.y = {"0", "1"};
  map.cells = {{{100, ""}, {200, ""}, {300, ""}}, {{0, "collision"}, {0, "converged"}, {}}};
  return map;
}

struct Cell {
  double x;
  double y;
};

/// Where a text stands.
Cell place(const std::string& svg, const std::string& words) {
  const std::regex text("<text[^>]* x=\"([0-9.]+)\" y=\"([0-9.]+)\"[^>]*>" + words + "<");
  std::smatch found;
  if (!std::regex_search(svg, found, text)) return {-1, -1};
  return {std::stod(found[1]), std::stod(found[2])};
}

TEST(SvgHeatMap, CellsStandAtTheirNames) {
  const std::string svg = svg_heat_map(example());
  EXPECT_EQ(test::markup_fault(svg), "");
  EXPECT_NEAR(place(svg, "200").x, place(svg, "1").x, 0.2);
  EXPECT_NEAR(place(svg, "300").x, place(svg, "2").x, 0.2);
  EXPECT_NEAR(place(svg, "100").y, place(svg, "0").y, 0.2);
  EXPECT_GT(place(svg, "100").y, place(svg, "col").y);  // row 0 below row 1
}

TEST(SvgHeatMap, WordsAreHatchedShortenedAndExplained) {
  const std::string svg = svg_heat_map(example());
  EXPECT_THAT(svg, HasSubstr(">col<"));
  EXPECT_THAT(svg, HasSubstr(">con<"));
  EXPECT_THAT(svg, HasSubstr(">col: collision<"));
  EXPECT_THAT(svg, HasSubstr(">con: converged<"));
  EXPECT_THAT(svg, HasSubstr("stroke=\"#8f4a12\""));
}

TEST(SvgHeatMap, MoreIsDarker) {
  const std::string svg = svg_heat_map(example());
  const std::regex box("fill=\"#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})\"");
  std::vector<int> sums;
  for (std::sregex_iterator b(svg.begin(), svg.end(), box), end; b != end && sums.size() < 3; ++b)
    sums.push_back(std::stoi((*b)[1], nullptr, 16) + std::stoi((*b)[2], nullptr, 16));
  ASSERT_EQ(sums.size(), 3u);
  EXPECT_GT(sums[0], sums[1]);
  EXPECT_GT(sums[1], sums[2]);
}

TEST(SvgHeatMap, HatchStaysInItsCell) {
  HeatMap map = example();
  map.x = {"only"};
  map.y = {"row"};
  for (const char* word : {"a", "b", "c", "d", "e", "f"}) {
    map.cells = {{{0, word}}};
    const std::string svg = svg_heat_map(map);
    const std::regex line("M(-?[0-9.]+) (-?[0-9.]+)L(-?[0-9.]+) (-?[0-9.]+)");
    for (std::sregex_iterator l(svg.begin(), svg.end(), line), end; l != end; ++l) {
      EXPECT_GE(std::stod((*l)[1]), 0);
      EXPECT_LE(std::stod((*l)[3]), map.width_px - 13);
      EXPECT_LE(std::stod((*l)[1]), std::stod((*l)[3]));
    }
  }
}

TEST(SvgHeatMap, NothingAndNonsenseAreWellFormed) {
  EXPECT_THAT(svg_heat_map({}), HasSubstr("no values to show"));
  HeatMap map = example();
  map.cells = {{{std::numeric_limits<double>::infinity(), ""}}, {}, {{1, ""}}};
  for (const HeatMap& one : {HeatMap(), map}) {
    const std::string svg = svg_heat_map(one);
    EXPECT_EQ(test::markup_fault(svg), "");
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
  }
}

}  // namespace
}  // namespace kestrel

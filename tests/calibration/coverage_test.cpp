#include "kestrel/calibration/coverage.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

BoardView view(const std::vector<Pixel>& pixels) {
  BoardView out;
  for (const Pixel& p : pixels) out.points.push_back({0, p});
  return out;
}

TEST(Coverage, HasSquareCells) {
  const Coverage wide = coverage({}, {640, 480});
  EXPECT_EQ(wide.columns, 8);
  EXPECT_EQ(wide.rows, 6);
  EXPECT_EQ(wide.share, 0);
  const Coverage high = coverage({}, {480, 640});
  EXPECT_EQ(high.columns, 6);
  EXPECT_EQ(high.rows, 8);
}

TEST(Coverage, CountsPointsWhereTheyAre) {
  const Coverage c =
      coverage({view({{0, 0}, {639, 479}}), view({{79.4, 0}, {79.6, 0}})}, {640, 480});
  EXPECT_EQ(c.counts[0], 2);  // pixels 0 to 79 are the first column
  EXPECT_EQ(c.counts[1], 1);
  EXPECT_EQ(c.counts[47], 1);
  EXPECT_DOUBLE_EQ(c.share, 3.0 / 48);
}

TEST(Coverage, PassesOverPointsOutside) {
  const Coverage c =
      coverage({view({{-1, 5}, {5, -1}, {640, 5}, {5, 480}, {std::nan(""), 5}})}, {640, 480});
  EXPECT_EQ(std::accumulate(c.counts.begin(), c.counts.end(), 0), 0);
}

TEST(Coverage, WantsASize) {
  EXPECT_THROW(coverage({}, {0, 480}), std::invalid_argument);
  EXPECT_THROW(coverage({}, {640, -1}), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

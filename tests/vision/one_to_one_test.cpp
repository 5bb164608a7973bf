#include "kestrel/vision/one_to_one.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

TEST(OneToOne, KeepsTheBestOfEachPlace) {
  const std::vector<Witness> all = {{{{10, 10}, {50, 50}}, 3, 0},      // outdone in the template
                                    {{{10.5, 10.5}, {60, 50}}, 1, 1},  // 0.7 px from it
                                    {{{30, 10}, {70, 50}}, 1, 2},
                                    {{{40, 10}, {70.5, 50}}, 2, 3},  // outdone in the image
                                    {{{10.5, 12}, {80, 50}}, 9, 4}};
  EXPECT_EQ(one_to_one(all, 1), (std::vector<int>{1, 2, 4}));
  EXPECT_EQ(one_to_one(all, 0.1), (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(one_to_one(all, 1000).size(), 1U);
  EXPECT_TRUE(one_to_one({}, 1).empty());
}

TEST(OneToOne, LeavesNoTwoAtOnePlaceInAnyOrder) {
  test::Random random("places");
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Witness> all;
    for (int i = 0; i < 200; ++i) {
      const Pixel p{random.uniform(0, 30), random.uniform(0, 30)};
      const Pixel q{random.uniform(0, 30), random.uniform(0, 30)};
      all.push_back({{p, q}, random.uniform(0, 9), i});
    }
    const std::vector<int> kept = one_to_one(all, 1);
    EXPECT_GT(kept.size(), 50U);
    for (const int i : kept) {
      for (const int j : kept) {
        if (i >= j) continue;
        const PixelPair& a = all[std::size_t(i)].pair;
        const PixelPair& b = all[std::size_t(j)].pair;
        EXPECT_GE(distance(a.in_template, b.in_template), 1);
        EXPECT_GE(distance(a.in_image, b.in_image), 1);
      }
    }
    std::reverse(all.begin(), all.end());
    EXPECT_EQ(one_to_one(all, 1), kept);
  }
}

TEST(OneToOne, LeavesOneOfThousandsAtOnePlace) {
  std::vector<Witness> all;
  all.reserve(20000);
  for (int i = 0; i < 20000; ++i) all.push_back({{{5, 5}, {7, 7}}, 20000.0 - i, i});
  EXPECT_EQ(one_to_one(all, 1), std::vector<int>{19999});
}

}  // namespace
}  // namespace kestrel

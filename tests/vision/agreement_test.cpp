#include "kestrel/vision/agreement.hpp"

#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

std::vector<BlockLikeness> blocks(int alike, int unlike, int hidden) {
  std::vector<BlockLikeness> all;
  for (int i = 0; i < unlike; ++i) all.push_back({true, 0.1});
  for (int i = 0; i < hidden; ++i) all.push_back({false, 0});
  for (int i = 0; i < alike; ++i) all.push_back({true, 0.9});
  return all;
}

bool accepts(std::vector<BlockLikeness> all) {
  const Agreement fine = agreement(all, {});
  return is_accepted({fine, {}}, {});
}

TEST(Agreement, CountsWhatIsVisibleAndAlike) {
  auto all = blocks(6, 4, 5);
  const Agreement a = agreement(all, {});
  EXPECT_EQ(a.blocks, 15);
  EXPECT_EQ(a.visible, 10);
  EXPECT_EQ(a.alike, 6);
  EXPECT_DOUBLE_EQ(a.alike_share(), 0.6);
  EXPECT_DOUBLE_EQ(a.visible_share(), 10.0 / 15);
  EXPECT_DOUBLE_EQ(a.better_half, 0.9);  // five of the six
}

TEST(Agreement, BetterHalfIsTheMeanOfTheMostAlike) {
  std::vector<BlockLikeness> all{{true, 0.2}, {true, 1.0}, {true, -0.5}, {true, 0.6}, {true, 0.4}};
  EXPECT_NEAR(agreement(all, {}).better_half, (1.0 + 0.6 + 0.4) / 3, 1e-12);
}

TEST(Agreement, SurvivesWhatCoversMoreThanHalf) {
  EXPECT_TRUE(accepts(blocks(40, 40, 0)));
  EXPECT_FALSE(accepts(blocks(20, 60, 0)));  // a quarter: less than the share that is asked for
}

TEST(Agreement, DoesNotBelieveACorner) {
  EXPECT_TRUE(accepts(blocks(20, 0, 40)));
  EXPECT_FALSE(accepts(blocks(20, 0, 80)));  // a fifth of the template in view
}

TEST(Agreement, DoesNotBelieveAFewBlocks) {
  EXPECT_TRUE(accepts(blocks(8, 0, 0)));
  EXPECT_FALSE(accepts(blocks(7, 0, 0)));
}

TEST(Agreement, OfTwoLevelsIsTheirMean) {
  auto fine = blocks(20, 80, 0);
  auto coarse = blocks(24, 6, 0);
  const PlaceAgreement both{agreement(fine, {}), agreement(coarse, {})};
  EXPECT_DOUBLE_EQ(both.alike_share(), (0.2 + 0.8) / 2);
  EXPECT_DOUBLE_EQ(both.better_half(), (both.fine.better_half + 0.9) / 2);
  EXPECT_DOUBLE_EQ(both.shown(), both.alike_share() * both.better_half());
}

TEST(Agreement, FourBlocksOfALevelAreNoEvidence) {
  auto fine = blocks(12, 12, 0);
  auto coarse = blocks(6, 2, 0);
  const PlaceAgreement small{agreement(fine, {}), agreement(coarse, {})};
  EXPECT_DOUBLE_EQ(small.evident_share(), (8.0 / 20 + 2.0 / 4) / 2);
  auto few = blocks(4, 0, 0);
  EXPECT_EQ((PlaceAgreement{agreement(few, {}), {}}.evident_share()), 0);
}

/// What a template of 64x51 px shows at half its size: two coarse blocks must not speak against it,
/// nor for it.
TEST(Agreement, ACoarseLevelOfAFewBlocksIsCountedWithTheFineOne) {
  const auto seen = [](int alike, int unlike, int alike_coarse, int unlike_coarse) {
    auto fine = blocks(alike, unlike, 0);
    auto coarse = blocks(alike_coarse, unlike_coarse, 0);
    return PlaceAgreement{agreement(fine, {}), agreement(coarse, {})};
  };
  EXPECT_DOUBLE_EQ(seen(11, 3, 2, 0).evident_share(), (13.0 - 8) / (16 - 8));
  EXPECT_TRUE(is_accepted(seen(11, 3, 2, 0), {}));
  EXPECT_DOUBLE_EQ(seen(8, 6, 1, 3).evident_share(), (9.0 - 8) / (18 - 8));
  EXPECT_FALSE(is_accepted(seen(8, 6, 2, 2), {}));  // as many as the fine level alone would need
  EXPECT_EQ(seen(4, 0, 4, 0).evident_share(), 0);
  EXPECT_DOUBLE_EQ(seen(14, 0, 5, 0).evident_share(), 1);  // five say something by themselves
  EXPECT_DOUBLE_EQ(seen(14, 0, 4, 1).evident_share(), 0.5);
}

TEST(Agreement, OfNothingIsNotAccepted) {
  EXPECT_FALSE(accepts({}));
  EXPECT_FALSE(accepts(blocks(0, 0, 30)));
}

TEST(Agreement, RefusesOptionsOutOfRange) {
  AgreementOptions options;
  options.check();
  options.alike_zncc = 1;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.min_alike_share = 1.1;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.min_better_half = -0.1;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.min_visible_share = 2;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.min_alike = 0;
  EXPECT_THROW(options.check(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

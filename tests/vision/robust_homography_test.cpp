#include "kestrel/vision/robust_homography.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "kestrel/vision/outline_deviation.hpp"

#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel {
namespace {

constexpr double kWidth = 120;
constexpr double kHeight = 90;

Homography some_view(test::Random& random) {
  test::Motion motion;
  motion.scale = std::exp(random.uniform(-0.7, 0.7));
  motion.angle = random.uniform(-M_PI, M_PI);
  motion.tilt = random.uniform(0, 0.8);
  motion.tilt_axis = random.uniform(0, M_PI);
  return test::moved(motion, {60, 45}, {random.uniform(100, 500), random.uniform(100, 400)});
}

Pixel in_template(test::Random& random) {
  return {random.uniform(0, kWidth - 1), random.uniform(0, kHeight - 1)};
}

/// The first `inliers` pairs follow H with this noise (px), the others are anywhere in the image.
std::vector<PixelPair> pairs_of(const Homography& H, int inliers, int outliers, double noise,
                                test::Random& random) {
  std::vector<PixelPair> pairs;
  for (int i = 0; i < inliers; ++i) {
    const Pixel p = in_template(random);
    const Pixel q = H * p;
    pairs.push_back({p, {q.u + noise * random.normal(), q.v + noise * random.normal()}});
  }
  for (int i = 0; i < outliers; ++i) {
    pairs.push_back({in_template(random), {random.uniform(0, 640), random.uniform(0, 480)}});
  }
  return pairs;
}

std::vector<PixelPair> chosen(const std::vector<PixelPair>& pairs, const std::vector<int>& which) {
  std::vector<PixelPair> result;
  result.reserve(which.size());
  for (const int i : which) result.push_back(pairs[std::size_t(i)]);
  return result;
}

TEST(RansacHomography, RecoversExactPairs) {
  test::Random random("exact");
  for (int i = 0; i < 20; ++i) {
    const Homography H = some_view(random);
    const auto found = ransac_homography(pairs_of(H, 20, 0, 0, random), {});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->inliers.size(), 20U);
    EXPECT_LT(test::corner_distance(found->image_from_template, H, kWidth, kHeight), 1e-6);
  }
}

TEST(RansacHomography, WithstandsSixtyPercentOutliers) {
  test::Random random("sixty");
  for (int i = 0; i < 40; ++i) {
    const Homography H = some_view(random);
    const auto pairs = pairs_of(H, 40, 60, 0.5, random);
    const auto found = ransac_homography(pairs, {});
    ASSERT_TRUE(found) << i;
    EXPECT_GE(found->inliers.size(), 38U);  // 3 px are six sigma
    // Four times the deviation that the noise of these inliers explains.
    const double deviation = outline_deviation_px(found->image_from_template,
                                                  chosen(pairs, found->inliers), kWidth, kHeight);
    EXPECT_LT(test::corner_distance(found->image_from_template, H, kWidth, kHeight), 4 * deviation);
  }
}

TEST(RansacHomography, IsTheFitOfExactlyItsInliers) {
  test::Random random("fit");
  const RansacOptions options;
  for (int i = 0; i < 20; ++i) {
    const auto pairs = pairs_of(some_view(random), 50, 30, 1.2, random);  // some beyond 3 px
    const auto found = ransac_homography(pairs, options);
    ASSERT_TRUE(found);
    const auto refit = fit_homography(chosen(pairs, found->inliers));
    ASSERT_TRUE(refit);
    EXPECT_EQ((refit->H - found->image_from_template.H).cwiseAbs().maxCoeff(), 0);
    std::vector<int> within;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const Pixel p = found->image_from_template * pairs[k].in_template;
      if (distance(p, pairs[k].in_image) < options.max_reprojection_px) within.push_back(int(k));
    }
    EXPECT_EQ(within, found->inliers);
  }
}

TEST(RansacHomography, IsTheSameBitsForTheSameSeed) {
  test::Random random("bits");
  const auto pairs = pairs_of(some_view(random), 30, 40, 0.7, random);
  const auto first = ransac_homography(pairs, {});
  const auto again = ransac_homography(pairs, {});
  ASSERT_TRUE(first && again);
  EXPECT_EQ(first->image_from_template.H, again->image_from_template.H);
  EXPECT_EQ(first->inliers, again->inliers);
  EXPECT_EQ(first->trials, again->trials);
}

TEST(RansacHomography, FindsTheSameWithOtherDraws) {
  test::Random random("draws");
  const Homography H = some_view(random);
  const auto pairs = pairs_of(H, 40, 60, 0, random);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    RansacOptions options;
    options.seed = seed;
    const auto found = ransac_homography(pairs, options);
    ASSERT_TRUE(found);
    EXPECT_LT(test::corner_distance(found->image_from_template, H, kWidth, kHeight), 1e-5);
  }
}

TEST(RansacHomography, EndsWithConfidenceNotBefore) {
  // Half inliers: 1 - (1 - 1/16)^n = 0.999 for n = 107. Draws in luck must not end it sooner, and
  // draws without luck in the first 3 x 107 have a chance of 1e-9.
  test::Random random("confidence");
  const double needed = std::log(0.001) / std::log(1 - 1.0 / 16);
  for (int i = 0; i < 10; ++i) {
    const auto pairs = pairs_of(some_view(random), 60, 60, 0, random);
    const auto found = ransac_homography(pairs, {});
    ASSERT_TRUE(found);
    EXPECT_LT(found->inliers.size(), 63U);  // an outlier or two may lie on the plane by chance
    EXPECT_GE(found->trials, 0.8 * needed);
    EXPECT_LE(found->trials, 3 * needed);
  }
}

TEST(RansacHomography, NeverTriesMoreThanAllowed) {
  test::Random random("bound");
  for (const int bound : {1, 5, 100}) {
    RansacOptions options;
    options.max_trials = bound;
    const auto found = ransac_homography(pairs_of(some_view(random), 60, 20, 0, random), options);
    EXPECT_LE(found ? found->trials : 0, bound);
  }
  RansacOptions one;
  one.max_trials = 1;
  int lucky = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    one.seed = seed;
    lucky += ransac_homography(pairs_of(some_view(random), 10, 40, 0, random), one) ? 1 : 0;
  }
  EXPECT_LE(lucky, 2);  // one draw of four inliers of 50 has a chance of 0.0009
}

TEST(RansacHomography, IsEmptyWithoutConsensus) {
  test::Random random("chance");
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(ransac_homography(pairs_of({}, 0, 60, 0, random), {}));
  }
  const Homography H = some_view(random);
  EXPECT_FALSE(ransac_homography(pairs_of(H, 7, 0, 0, random), {}));
  EXPECT_TRUE(ransac_homography(pairs_of(H, 8, 0, 0, random), {}));
  EXPECT_FALSE(ransac_homography({}, {}));
}

TEST(RansacHomography, IsNeverAMirrorImage) {
  test::Random random("mirror");
  Homography mirror;
  mirror.H << -1, 0, 300, 0, 1, 100, 0, 0, 1;
  EXPECT_FALSE(ransac_homography(pairs_of(mirror, 40, 0, 0.3, random), {}));
}

TEST(RansacHomography, IsEmptyForPairsThatDetermineNone) {
  std::vector<PixelPair> line;
  std::vector<PixelPair> point;
  for (int i = 0; i < 40; ++i) {
    line.push_back({{2.0 * i, 1.0 * i}, {100 + 2.0 * i, 50 + 1.0 * i}});
    point.push_back({{5, 5}, {70, 80}});
  }
  EXPECT_FALSE(ransac_homography(line, {}));
  EXPECT_FALSE(ransac_homography(point, {}));
}

TEST(RansacHomography, TakesNoSupportFromBehindTheCamera) {
  // Depth changes its sign at u = 60: the pairs beyond it fit the formula, but no camera sees them.
  Homography H;
  H.H << 1, 0, 0, 0, 1, 0, -1.0 / 60, 0, 1;
  test::Random random("behind");
  std::vector<PixelPair> pairs;
  for (int i = 0; i < 60; ++i) {
    const bool behind = i >= 40;
    const Pixel p{behind ? random.uniform(75, 119) : random.uniform(0, 45),
                  random.uniform(0, kHeight)};
    pairs.push_back({p, H * p});
  }
  const auto found = ransac_homography(pairs, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->inliers.size(), 40U);
  EXPECT_EQ(found->inliers.back(), 39);
}

TEST(RansacHomography, IgnoresPairsThatAreNotFinite) {
  test::Random random("nan");
  const Homography H = some_view(random);
  auto pairs = pairs_of(H, 30, 0, 0, random);
  pairs[3].in_image.u = std::numeric_limits<double>::quiet_NaN();
  pairs[4].in_template.v = std::numeric_limits<double>::quiet_NaN();
  pairs[5].in_image.v = std::numeric_limits<double>::infinity();
  const auto found = ransac_homography(pairs, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->inliers.size(), 27U);
  EXPECT_LT(test::corner_distance(found->image_from_template, H, kWidth, kHeight), 1e-6);
}

TEST(Consensus, IsTheLargerOfTheTwoBounds) {
  RansacOptions options;
  options.min_inliers = 8;
  options.min_inlier_share = 0.15;
  EXPECT_EQ(consensus(0, options), 8);
  EXPECT_EQ(consensus(20, options), 8);
  EXPECT_EQ(consensus(53, options), 8);
  EXPECT_EQ(consensus(54, options), 9);  // 8.1 rounded up
  EXPECT_EQ(consensus(200, options), 30);
  for (std::size_t n = 1; n < 500; ++n) EXPECT_GE(consensus(n, options), consensus(n - 1, options));
}

TEST(Consensus, IsAskedOfALargeTable) {
  test::Random random("share");
  RansacOptions options;
  options.min_inlier_share = 0.5;
  options.max_trials = 300;
  const Homography H = some_view(random);
  EXPECT_FALSE(ransac_homography(pairs_of(H, 45, 55, 0.1, random), options));
  EXPECT_TRUE(ransac_homography(pairs_of(H, 55, 45, 0.1, random), options));
}

TEST(RansacOptions, NamesWhatIsOutOfRange) {
  EXPECT_NO_THROW(RansacOptions().check());
  RansacOptions options;
  options.max_reprojection_px = 0;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.min_inliers = 3;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.min_inlier_share = 1.5;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.max_trials = 0;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.confidence = 1;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options.confidence = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(options.check(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

#include "kestrel/vision/vote_homography.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "support/planted_pairs.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

constexpr double kWidth = 160;
constexpr double kHeight = 120;

std::vector<FittedHomography> fits(const std::vector<AffinePair>& pairs) {
  return vote_homographies(pairs, kWidth, kHeight, {});
}

double corner_error_px(const FittedHomography& fit, const Homography& truth) {
  return test::corner_distance(fit.image_from_template, truth, kWidth, kHeight);
}

test::PlantedOptions planted_options(int inliers, int outliers) {
  test::PlantedOptions o;
  o.inliers = inliers;
  o.outliers = outliers;
  return o;
}

TEST(VoteHomographies, AreExactWithoutNoise) {
  test::Random random("exact");
  for (int i = 0; i < 20; ++i) {
    auto o = planted_options(30, 0);
    o.noise_px = 0;  // places only: the linear maps stay as noisy as those of keypoints
    const Homography H = test::planted_view(random.uniform(0, M_PI / 3), o, random);
    const auto found = fits(test::planted(H, o, random));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_LT(corner_error_px(found[0], H), 1e-6);  // double at 1e3 px, through a few steps
    EXPECT_GE(found[0].inliers.size(), 27U);        // of 30; some are within 1 px of each other
    EXPECT_NEAR(found[0].support, double(found[0].inliers.size()), 1e-6);
  }
}

struct Mix {
  int pairs;
  double inlier_share;
  double noise_px;
  double max_tilt;
  test::LinearMap map;
};

/// Share of planted views found within 5 px at the corners, the best answer only.
double success(const Mix& mix, int trials, test::Random& random) {
  const int inliers = int(std::lround(mix.inlier_share * mix.pairs));
  test::PlantedOptions o = planted_options(inliers, mix.pairs - inliers);
  o.noise_px = mix.noise_px;
  o.map = mix.map;
  int good = 0;
  for (int i = 0; i < trials; ++i) {
    const double tilt = mix.map == test::LinearMap::Similarity ? random.uniform(M_PI / 4, M_PI / 3)
                                                               : random.uniform(0, mix.max_tilt);
    const Homography H = test::planted_view(tilt, o, random);
    const auto found = fits(test::shuffled(test::planted(H, o, random), random));
    good += !found.empty() && corner_error_px(found[0], H) < 5 ? 1 : 0;
  }
  return double(good) / trials;
}

TEST(VoteHomographies, AreFoundAmongOutliers) {
  test::Random random("outliers");
  for (const auto map : {test::LinearMap::Affine, test::LinearMap::Similarity}) {
    for (const double noise_px : {0.5, 1.0}) {
      // Twelve inliers: with 1 px of noise some of their fits err by more than 5 px at a corner
      // that none of them is near. 99 % expected; 0.96 is three binomial deviations below.
      EXPECT_GE(success({60, 0.2, noise_px, M_PI / 3, map}, 100, random), 0.96);
      EXPECT_GE(success({60, 0.3, noise_px, M_PI / 3, map}, 60, random), 0.98);
      EXPECT_EQ(success({60, 0.5, noise_px, M_PI / 3, map}, 40, random), 1);
      EXPECT_EQ(success({200, 0.1, noise_px, M_PI / 3, map}, 40, random), 1);
      EXPECT_EQ(success({200, 0.3, noise_px, M_PI / 3, map}, 40, random), 1);
      EXPECT_EQ(success({200, 0.5, noise_px, M_PI / 3, map}, 40, random), 1);
    }
  }
}

TEST(VoteHomographies, HaveTheTrueInliers) {
  test::Random random("inliers");
  for (int i = 0; i < 20; ++i) {
    const auto o = planted_options(60, 60);
    const Homography H = test::planted_view(0.7, o, random);
    const auto found = fits(test::planted(H, o, random));
    ASSERT_FALSE(found.empty());
    EXPECT_TRUE(std::is_sorted(found[0].inliers.begin(), found[0].inliers.end()));
    const auto wrong = std::count_if(found[0].inliers.begin(), found[0].inliers.end(),
                                     [](int k) { return k >= 60; });
    EXPECT_LE(wrong, 1);  // 28 px^2 of a frame of 307 200: 0.006 of 60 expected
    // Of 60, some at one place, 2 % turned too far, 1e-4 beyond 4 sigma of noise.
    EXPECT_GE(found[0].inliers.size(), 48U);
  }
}

TEST(VoteHomographies, AreTheSameForAnyOrderOfPairs) {
  test::Random random("order");
  for (int i = 0; i < 10; ++i) {
    const auto o = planted_options(30, 90);
    const Homography H = test::planted_view(0.6, o, random);
    const auto pairs = test::planted(H, o, random);
    const auto other = test::shuffled(pairs, random);
    const auto a = fits(pairs);
    const auto b = fits(other);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_LT(corner_error_px(a[k], b[k].image_from_template), 1e-9);  // order of the sums
      std::vector<int> named;
      for (const int j : b[k].inliers) named.push_back(other[std::size_t(j)].template_index);
      std::sort(named.begin(), named.end());
      EXPECT_EQ(a[k].inliers, named);
    }
  }
}

TEST(VoteHomographies, AskTheMostDistinctivePairsFirst) {
  test::Random random("distinctive");
  VoteOptions options;
  options.max_voters = 10;
  const auto o = planted_options(20, 150);
  auto pairs = test::planted(test::planted_view(0.3, o, random), o, random);
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].ratio = i < 20 ? 0.6F : 0.9F;
  EXPECT_FALSE(vote_homographies(pairs, kWidth, kHeight, options).empty());
  for (AffinePair& pair : pairs) pair.ratio = 1.5F - pair.ratio;
  EXPECT_TRUE(vote_homographies(pairs, kWidth, kHeight, options).empty());
}

TEST(VoteHomographies, AreNoneForPureChance) {
  test::Random random("chance");
  int answers = 0;
  for (int i = 0; i < 200; ++i) {
    const auto found = fits(test::planted({}, planted_options(0, 100), random));
    answers += found.empty() ? 0 : 1;
    for (const auto& fit : found) EXPECT_LT(fit.inliers.size(), 8U);
  }
  EXPECT_LE(answers, 4);  // six that agree by chance: two in a hundred at the most
}

TEST(VoteHomographies, AreSeveralForARepeatedTemplate) {
  test::Random random("several");
  int both = 0;
  for (int i = 0; i < 40; ++i) {
    const auto o = planted_options(25, 30);
    const Homography H = test::planted_view(0.4, o, random);
    const Homography repeated = test::product(test::translation(40, 25), H);
    auto pairs = test::planted(H, o, random);
    const auto more = test::planted(repeated, planted_options(20, 0), random);
    pairs.insert(pairs.end(), more.begin(), more.end());
    const auto found = fits(pairs);
    const auto has = [&](const Homography& truth) {
      return std::any_of(found.begin(), found.end(),
                         [&](const auto& fit) { return corner_error_px(fit, truth) < 5; });
    };
    both += has(H) && has(repeated) ? 1 : 0;
    for (std::size_t k = 1; k < found.size(); ++k) {
      EXPECT_LE(found[k].support, found[k - 1].support);
      EXPECT_GE(corner_error_px(found[k], found[k - 1].image_from_template), 6);
    }
  }
  EXPECT_GE(both, 36);
}

TEST(VoteHomographies, CountAPlaceOnce) {
  test::Random random("once");
  auto o = planted_options(30, 0);
  const Homography H = test::planted_view(0.4, o, random);
  auto pairs = test::planted(H, o, random);
  const auto single = fits(pairs);
  for (std::size_t i = 0; i < 30; ++i) {  // every keypoint has a second orientation
    AffinePair twin = pairs[i];
    twin.in_template.u += 0.2;
    twin.in_image.v += 0.3;
    pairs.push_back(twin);
  }
  const auto twice = fits(pairs);
  ASSERT_EQ(single.size(), 1U);
  ASSERT_EQ(twice.size(), 1U);
  EXPECT_LE(twice[0].inliers.size(), single[0].inliers.size() + 1);
  EXPECT_GE(twice[0].inliers.size(), single[0].inliers.size() - 3);
}

TEST(VoteHomographies, AreNeverMirrorImages) {
  test::Random random("mirror");
  Homography mirror;
  mirror.H << -1, 0, 300, 0, 1, 100, 0, 0, 1;
  const auto o = planted_options(40, 10);
  EXPECT_TRUE(fits(test::planted(mirror, o, random)).empty());
  auto pairs = test::planted(mirror, o, random);
  for (AffinePair& pair : pairs) pair.image_from_template.setIdentity();
  for (const auto& fit : fits(pairs)) EXPECT_LT(fit.inliers.size(), 12U);
}

TEST(VoteHomographies, TakeNoSupportFromBehindTheCamera) {
  // Depth changes its sign at u = 80: the pairs beyond it fit the formula, but no camera sees them.
  Homography H;
  H.H << 1, 0, 0, 0, 1, 0, -1.0 / 80, 0, 1;
  test::Random random("behind");
  auto pairs = test::planted(H, planted_options(80, 0), random);
  for (const auto& fit : fits(pairs)) {
    const Eigen::Vector3d row = fit.image_from_template.H.row(2);
    for (const Pixel& corner : template_corners(kWidth, kHeight)) {
      EXPECT_GT(row.dot(Eigen::Vector3d(corner.u, corner.v, 1)), 0);
    }
  }
}

TEST(VoteHomographies, AreEmptyForPairsThatDetermineNone) {
  test::Random random("degenerate");
  EXPECT_TRUE(fits({}).empty());
  const auto good = test::planted(test::translation(200, 100), planted_options(30, 0), random);
  EXPECT_TRUE(fits({good.begin(), good.begin() + 3}).empty());
  EXPECT_TRUE(fits(std::vector<AffinePair>(50, good[0])).empty());
  EXPECT_TRUE(fits(std::vector<AffinePair>(5000, good[0])).empty());
  std::vector<AffinePair> line;
  for (int i = 0; i < 40; ++i) {
    AffinePair pair;
    pair.in_template = {3.0 * i, 2.0 * i};
    pair.in_image = {100 + 3.0 * i, 50 + 2.0 * i};
    line.push_back(pair);
  }
  EXPECT_TRUE(fits(line).empty());
  EXPECT_TRUE(vote_homographies(good, 1, 1, {}).empty());
}

TEST(VoteHomographies, IgnorePairsThatAreNotFinite) {
  test::Random random("nan");
  const auto o = planted_options(40, 0);
  const Homography H = test::planted_view(0.3, o, random);
  auto pairs = test::planted(H, o, random);
  pairs[3].in_image.u = std::numeric_limits<double>::quiet_NaN();
  pairs[4].in_template.v = std::numeric_limits<double>::quiet_NaN();
  pairs[5].in_image.v = std::numeric_limits<double>::infinity();
  pairs[6].image_from_template(1, 1) = std::numeric_limits<float>::quiet_NaN();
  pairs[7].in_image.u = 1e300;
  const auto found = fits(pairs);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(corner_error_px(found[0], H), 3);
  for (const int bad : {3, 4, 5, 6, 7}) {
    EXPECT_EQ(std::count(found[0].inliers.begin(), found[0].inliers.end(), bad), 0);
  }
}

TEST(VoteHomographies, HandleThousandsOfPairs) {
  test::Random random("thousands");
  const auto o = planted_options(1000, 4000);
  const Homography H = test::planted_view(0.5, o, random);
  const auto found = fits(test::planted(H, o, random));
  ASSERT_FALSE(found.empty());
  EXPECT_LT(corner_error_px(found[0], H), 1);
}

TEST(VoteHomographies, SayHowWellTheyAreDetermined) {
  // The sum of squares of eight numbers in units of their covariance is 8 on average; 200 of them
  // give it to sqrt(16 / 200) = 0.28. The least noise is below that of the pairs.
  test::Random random("covariance");
  VoteOptions options;
  options.least_noise_px = 0.1;
  double sum = 0;
  const int repeats = 200;
  for (int i = 0; i < repeats; ++i) {
    auto o = planted_options(60, 20);
    o.noise_px = 0.6;
    const Homography H = test::planted_view(0.5, o, random);
    const auto found = vote_homographies(test::planted(H, o, random), kWidth, kHeight, options);
    ASSERT_FALSE(found.empty());
    Eigen::Matrix<double, 8, 1> d;
    const auto p = outline(found[0].image_from_template, kWidth, kHeight);
    const auto q = outline(H, kWidth, kHeight);
    for (std::size_t k = 0; k < 4; ++k) {
      d.segment<2>(Eigen::Index(2 * k)) << p[k].u - q[k].u, p[k].v - q[k].v;
    }
    sum += d.dot(found[0].corner_covariance.ldlt().solve(d)) / repeats;
  }
  EXPECT_NEAR(sum, 8, 1.5);
}

TEST(VoteOptions, NameWhatIsOutOfRange) {
  EXPECT_NO_THROW(VoteOptions().check());
  const auto complains = [](auto change) {
    VoteOptions options;
    change(options);
    EXPECT_THROW(options.check(), std::invalid_argument);
  };
  for (double VoteOptions::*field :
       {&VoteOptions::max_reprojection_px, &VoteOptions::min_vote_share,
        &VoteOptions::first_noise_share, &VoteOptions::perspective, &VoteOptions::distinct_px,
        &VoteOptions::same_place_px, &VoteOptions::least_noise_px}) {
    complains([&](VoteOptions& o) { o.*field = -1; });
    complains([&](VoteOptions& o) { o.*field = std::numeric_limits<double>::quiet_NaN(); });
  }
  for (int VoteOptions::*field :
       {&VoteOptions::min_inliers, &VoteOptions::max_hypotheses, &VoteOptions::max_tries,
        &VoteOptions::max_voters, &VoteOptions::min_votes}) {
    complains([&](VoteOptions& o) { o.*field = 0; });
  }
  complains([](VoteOptions& o) { o.agreement.log_scale = 0; });
}

}  // namespace
}  // namespace kestrel

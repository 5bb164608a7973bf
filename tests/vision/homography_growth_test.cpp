#include "kestrel/vision/homography_growth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "support/planted_pairs.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

constexpr double kWidth = 160;
constexpr double kHeight = 120;

test::PlantedOptions planted_options(int inliers, int outliers) {
  test::PlantedOptions o;
  o.inliers = inliers;
  o.outliers = outliers;
  return o;
}

double corner_error_px(const GrownHomography& grown, const Homography& truth) {
  return test::corner_distance(*uncentred(grown.image_from_scaled, kWidth, kHeight), truth, kWidth,
                               kHeight);
}

TEST(HomographyGrowth, GrowsTheTruthFromMostInliers) {
  test::Random random("most");
  int grown_right = 0;
  for (int i = 0; i < 5; ++i) {
    const auto o = planted_options(40, 40);
    const Homography H = test::planted_view(random.uniform(0, M_PI / 3), o, random);
    const auto pairs = test::planted(H, o, random);
    const AffineVotes votes(pairs, {});
    const HomographyGrowth growth(pairs, votes, kWidth, kHeight, {});
    for (std::size_t voter = 0; voter < 40; ++voter) {
      const auto grown = growth.grown(voter);
      grown_right += grown && corner_error_px(*grown, H) < 5 ? 1 : 0;
    }
  }
  EXPECT_GE(grown_right, 180);  // of 200: the first guesses err by 15 % and 10 degrees and tilt
}

TEST(HomographyGrowth, IsTheLeastSquaresFitOfItsInliers) {
  // At the least squares the residuals are orthogonal to the Jacobian: another step moves nothing.
  test::Random random("least squares");
  const auto o = planted_options(40, 10);
  const auto pairs = test::planted(test::planted_view(0.8, o, random), o, random);
  const AffineVotes votes(pairs, {});
  const HomographyGrowth growth(pairs, votes, kWidth, kHeight, {});
  for (std::size_t voter = 0; voter < 10; ++voter) {
    const auto grown = growth.grown(voter);
    if (!grown) continue;
    HomographyStep step(grown->image_from_scaled);
    double support = 0;
    for (const int i : grown->inliers) {
      const AffinePair& pair = pairs[std::size_t(i)];
      const Eigen::Vector2d p = centred(pair.in_template, kWidth, kHeight);
      step.add(p, pair.in_image, 1);
      const Seen at = seen(grown->image_from_scaled, p);
      support += 1 - std::pow(distance({at.u, at.v}, pair.in_image) / 3, 2);
    }
    const auto next = step.taken(0);
    ASSERT_TRUE(next);
    // Gauss-Newton converges by a factor of 100 a step at 0.7 px; coordinates reach 500 px.
    EXPECT_LT((next->G - grown->image_from_scaled.G).norm(), 0.01);
    EXPECT_NEAR(grown->support, support, 0.2);  // counted one refit earlier
  }
}

TEST(HomographyGrowth, GrowsWithoutWhatIsClosed) {
  test::Random random("closed");
  const auto o = planted_options(30, 0);
  const Homography H = test::planted_view(0.3, o, random);
  const auto pairs = test::planted(H, o, random);
  const AffineVotes votes(pairs, {});
  HomographyGrowth growth(pairs, votes, kWidth, kHeight, {});
  const auto first = growth.grown(0);
  ASSERT_TRUE(first);
  growth.close(first->image_from_scaled);
  for (const int i : first->inliers) EXPECT_FALSE(growth.is_open(std::size_t(i)));
  for (std::size_t i = 0; i < 30; ++i) EXPECT_FALSE(growth.grown(i));
}

TEST(HomographyGrowth, GrowsIntoTheCopyThatTheVoterBelongsTo) {
  test::Random random("copies");
  int own = 0;
  for (int i = 0; i < 5; ++i) {
    auto o = planted_options(25, 0);
    o.log_scale_sigma = o.angle_sigma = 0.03;  // near enough to tell the copies, 60 px apart
    const Homography H = test::planted_view(0.3, o, random);
    const Homography copy = test::product(test::translation(50, 33), H);
    auto pairs = test::planted(H, o, random);
    const auto more = test::planted(copy, o, random);
    pairs.insert(pairs.end(), more.begin(), more.end());
    const AffineVotes votes(pairs, {});
    const HomographyGrowth growth(pairs, votes, kWidth, kHeight, {});
    for (std::size_t voter = 0; voter < 50; ++voter) {
      const auto grown = growth.grown(voter);
      own += grown && corner_error_px(*grown, voter < 25 ? H : copy) < 5 ? 1 : 0;
    }
  }
  EXPECT_GE(own, 225);  // of 250
}

TEST(HomographyGrowth, IsNeverAMirrorImage) {
  // So near to a line that the votes' tolerance cannot see it, the places alone are mirrored.
  test::Random random("mirror");
  std::vector<AffinePair> pairs(40);
  for (AffinePair& pair : pairs) {
    const double y = random.uniform(-3, 3);
    pair.in_template = {random.uniform(0, kWidth - 1), 60 + y};
    pair.in_image = {pair.in_template.u + 200, 160 - y};
  }
  const AffineVotes votes(pairs, {});
  const HomographyGrowth growth(pairs, votes, kWidth, kHeight, {});
  for (std::size_t voter = 0; voter < 40; ++voter) {
    const auto grown = growth.grown(voter);
    if (!grown) continue;
    EXPECT_GT(signed_area(
                  outline(*uncentred(grown->image_from_scaled, kWidth, kHeight), kWidth, kHeight)),
              0);
  }
}

TEST(HomographyGrowth, NeedsItsInliers) {
  test::Random random("few");
  const auto o = planted_options(5, 0);
  const Homography H = test::planted_view(0.3, o, random);
  const auto pairs = test::planted(H, o, random);
  const AffineVotes votes(pairs, {});
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_FALSE(HomographyGrowth(pairs, votes, kWidth, kHeight, {}).grown(i));
  }
}

TEST(GrowthOptions, NameWhatIsOutOfRange) {
  EXPECT_NO_THROW(GrowthOptions().check());
  for (double GrowthOptions::*field :
       {&GrowthOptions::max_reprojection_px, &GrowthOptions::first_noise_share,
        &GrowthOptions::perspective, &GrowthOptions::same_place_px}) {
    GrowthOptions options;
    options.*field = 0;
    EXPECT_THROW(options.check(), std::invalid_argument);
    options.*field = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(options.check(), std::invalid_argument);
  }
  GrowthOptions options;
  options.min_inliers = 4;
  EXPECT_THROW(options.check(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

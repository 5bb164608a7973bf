#include "kestrel/vision/affine_votes.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "support/planted_pairs.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

AffinePair pair_at(const Pixel& in_template, const Pixel& in_image, double angle,
                   double log_scale) {
  AffinePair pair;
  pair.in_template = in_template;
  pair.in_image = in_image;
  pair.image_from_template = test::turn_and_scale(angle, log_scale).cast<float>();
  return pair;
}

TEST(AffineVotes, AreGivenByEveryPairOfOneAffineMap) {
  test::Random random("affine");
  Homography H;
  H.H << 1.2, -0.7, 200, 0.5, 0.9, 100, 0, 0, 1;
  test::PlantedOptions o;
  o.inliers = 40;
  o.outliers = 0;
  o.noise_px = o.log_scale_sigma = o.angle_sigma = 0;
  const auto pairs = test::planted(H, o, random);
  AffineVoteOptions strict;
  strict.position_px = 0.01;  // float: coordinates of 1e3 px to 1e-4
  strict.position_share = 0;
  strict.log_scale = 0.01;
  strict.same_place_px = 1e-3;
  const AffineVotes votes(pairs, strict);
  for (std::size_t i = 0; i < pairs.size(); ++i) EXPECT_EQ(votes.count(i), 39);
}

TEST(AffineVotes, CountTheSupporters) {
  test::Random random("count");
  const auto pairs = test::planted(test::planted_view(0.5, {}, random), {}, random);
  const AffineVotes votes(pairs, {});
  int all = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(votes.count(i), int(votes.supporters(i).size()));
    all += votes.count(i);
    for (const int j : votes.supporters(i)) EXPECT_NE(j, int(i));
  }
  EXPECT_GT(all, 30 * 15);  // most of the 30 inliers agree with most others
}

TEST(AffineVotes, LetChancePairsThroughOnceInAThousand) {
  test::Random random("chance");
  test::PlantedOptions o;
  o.inliers = 0;
  o.outliers = 300;
  const auto pairs = test::planted({}, o, random);
  const AffineVotes votes(pairs, {});
  int all = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) all += votes.count(i);
  EXPECT_LT(all, 3 * 300 * 300 / 1000);  // 90 000 tries: 90 expected; scales differ, so up to three
}

/// The largest difference that still agrees, by bisection; `other` makes a pair of a difference.
template <class Other>
double bound(const AffinePair& voter, const AffineVoteOptions& options, Other other) {
  double low = 0;
  double high = 1000;
  while (high - low > 1e-5) {
    const double middle = (low + high) / 2;
    const AffineVotes votes({voter, other(middle)}, options);
    (votes.count(0) == 1 ? low : high) = middle;
  }
  return low;
}

TEST(AffineVotes, AllowTheBoundsOfTheirOptions) {
  const AffineVoteOptions o;
  const AffinePair voter = pair_at({20, 20}, {100, 100}, 0.4, std::log(2));
  const auto predicted = [](double far) {
    return Pixel{100 + 2 * far * std::cos(0.4), 100 + 2 * far * std::sin(0.4)};
  };
  const auto moved = [&](double far, double by) {
    return pair_at({20 + far, 20}, {predicted(far).u, predicted(far).v + by}, 0.4, std::log(2));
  };
  // Position: a constant and a share of the distance in the image (here twice that of the
  // template), added in squares. Tolerances: float at 1e2 px squared.
  EXPECT_NEAR(bound(voter, o, [&](double d) { return moved(2, d); }), std::hypot(6, 0.5 * 4), 1e-3);
  EXPECT_NEAR(bound(voter, o, [&](double d) { return moved(-2, -d); }), std::hypot(6, 2), 1e-3);
  EXPECT_NEAR(bound(voter, o, [&](double d) { return moved(40, d); }), std::hypot(6, 40), 1e-3);
  // Scale: the same factor up and down. Angle: the same both ways, acos(1 / cosh(log_scale)).
  const auto grown = [&](double by) {
    return pair_at({30, 20}, predicted(10), 0.4, std::log(2) + by);
  };
  const auto turned = [&](double by) {
    return pair_at({30, 20}, predicted(10), 0.4 + std::min(by, 3.0), std::log(2));
  };
  EXPECT_NEAR(bound(voter, o, [&](double d) { return grown(std::min(d, 9.0)); }), o.log_scale,
              1e-4);
  EXPECT_NEAR(bound(voter, o, [&](double d) { return grown(-std::min(d, 9.0)); }), o.log_scale,
              1e-4);
  const double angle = std::acos(1 / std::cosh(o.log_scale));
  EXPECT_NEAR(bound(voter, o, turned), angle, 1e-4);
  EXPECT_NEAR(bound(voter, o, [&](double d) { return turned(-std::min(d, 3.0)); }), angle, 1e-4);
}

TEST(AffineVotes, TakeNoSecondWitnessAtOnePlace) {
  const AffinePair voter = pair_at({20, 20}, {100, 100}, 0, 0);
  EXPECT_EQ(AffineVotes({voter, pair_at({20.5, 20}, {100.5, 100}, 0, 0)}, {}).count(0), 0);
  EXPECT_EQ(AffineVotes({voter, pair_at({22, 20}, {102, 100}, 0, 0)}, {}).count(0), 1);
}

TEST(AffineVotes, AreNotGivenByNonsense) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double huge = std::numeric_limits<double>::infinity();
  const AffinePair good = pair_at({20, 20}, {100, 100}, 0, 0);
  std::vector<AffinePair> bad(6, pair_at({25, 20}, {105, 100}, 0, 0));
  bad[0].in_template.u = none;
  bad[1].in_image.v = huge;
  bad[2].image_from_template(0, 1) = std::numeric_limits<float>::quiet_NaN();
  bad[3].image_from_template(0, 0) = -1;  // a mirror image
  bad[4].image_from_template.setZero();
  bad[5].in_template.v = -huge;
  for (const AffinePair& pair : bad) {
    const AffineVotes votes({good, pair, pair}, {});
    EXPECT_FALSE(votes.is_usable(1));
    EXPECT_EQ(votes.count(0), 0);
    EXPECT_EQ(votes.count(1), 0);
    EXPECT_TRUE(votes.supporters(1).empty());
    const TurnBounds bounds = votes.bounds(Eigen::Matrix2d::Identity());
    Eigen::Matrix3d H;
    H << 1, 0, 80, 0, 1, 80, 0, 0, 1;
    EXPECT_EQ(votes.near(H, bounds, 2), std::vector<int>{0});
  }
}

TEST(AffineVoteOptions, NameWhatIsOutOfRange) {
  EXPECT_NO_THROW(AffineVoteOptions().check());
  for (double AffineVoteOptions::*field :
       {&AffineVoteOptions::position_px, &AffineVoteOptions::position_share,
        &AffineVoteOptions::log_scale, &AffineVoteOptions::same_place_px}) {
    AffineVoteOptions options;
    options.*field = -1;
    EXPECT_THROW(options.check(), std::invalid_argument);
    options.*field = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(options.check(), std::invalid_argument);
  }
}

}  // namespace
}  // namespace kestrel

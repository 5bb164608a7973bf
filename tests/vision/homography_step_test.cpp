#include "kestrel/vision/homography_step.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel {
namespace {

constexpr double kWidth = 160;
constexpr double kHeight = 120;

Homography some_view(test::Random& random) {
  test::Motion motion;
  motion.scale = std::exp(random.uniform(-0.7, 0.7));
  motion.angle = random.uniform(-M_PI, M_PI);
  motion.tilt = random.uniform(0, 1);
  motion.tilt_axis = random.uniform(0, M_PI);
  return test::moved(motion, {80, 60}, {random.uniform(100, 500), random.uniform(100, 400)});
}

struct Weighted {
  PixelPair pair;
  double weight;
};

std::vector<Weighted> weighted_pairs(const Homography& H, int count, double noise,
                                     test::Random& random) {
  std::vector<Weighted> pairs;
  for (int i = 0; i < count; ++i) {
    const Pixel p{random.uniform(0, kWidth - 1), random.uniform(0, kHeight - 1)};
    const Pixel q = H * p;
    const Pixel seen_at{q.u + noise * random.normal(), q.v + noise * random.normal()};
    pairs.push_back({{p, seen_at}, random.uniform(0.1, 2)});
  }
  return pairs;
}

HomographyStep step_of(const CentredHomography& at, const std::vector<Weighted>& pairs) {
  HomographyStep step(at);
  for (const auto& [pair, weight] : pairs) {
    step.add(centred(pair.in_template, kWidth, kHeight), pair.in_image, weight);
  }
  return step;
}

TEST(CentredHomography, GoesThereAndBack) {
  test::Random random("there");
  for (int i = 0; i < 20; ++i) {
    const Homography H = some_view(random);
    const CentredHomography G = centred(H, kWidth, kHeight);
    EXPECT_DOUBLE_EQ(G.G(2, 2), 1);
    const auto back = uncentred(G, kWidth, kHeight);
    ASSERT_TRUE(back);
    EXPECT_LT((back->H - H.H).norm() / H.H.norm(), 1e-12);
    const Pixel p{random.uniform(0, kWidth), random.uniform(0, kHeight)};
    const Seen at = seen(G, centred(p, kWidth, kHeight));
    EXPECT_LT(distance({at.u, at.v}, H * p), 1e-9);
  }
}

TEST(CentredHomography, HasTheTemplateBetweenMinusOneAndOne) {
  const auto corners = template_corners(kWidth, kHeight);
  EXPECT_EQ(centred(corners[0], kWidth, kHeight), Eigen::Vector2d(-1, -1));
  EXPECT_EQ(centred(corners[2], kWidth, kHeight), Eigen::Vector2d(1, 1));
}

TEST(CentredHomography, IsEmptyWhenTheFirstPixelIsAtInfinity) {
  CentredHomography G;
  G.G(2, 0) = 1;
  EXPECT_FALSE(uncentred(G, kWidth, kHeight));
  G.G(2, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(uncentred(G, kWidth, kHeight));
}

TEST(HomographyStep, HasTheDerivativeAsJacobian) {
  test::Random random("jacobian");
  for (int i = 0; i < 10; ++i) {
    const CentredHomography G = centred(some_view(random), kWidth, kHeight);
    const Eigen::Vector2d p(random.uniform(-1, 1), random.uniform(-1, 1));
    const auto J = HomographyStep::jacobian(G, p);
    for (int k = 0; k < 8; ++k) {
      CentredHomography more = G;
      CentredHomography less = G;
      const double step = k < 6 ? 1e-4 : 1e-6;
      more.G(k / 3, k % 3) += step;
      less.G(k / 3, k % 3) -= step;
      const Seen a = seen(more, p);
      const Seen b = seen(less, p);
      const Eigen::Vector2d d((a.u - b.u) / (2 * step), (a.v - b.v) / (2 * step));
      // Rounding of 1e-13 px over a step of 1e-6; elements of the last column reach 1e3.
      EXPECT_LT((J.col(k) - d).norm(), 1e-5);
    }
  }
}

/// The 8 x 8 system without any structure used.
struct Dense {
  HomographyStep::Information M = HomographyStep::Information::Zero();
  Eigen::Matrix<double, 8, 1> b = Eigen::Matrix<double, 8, 1>::Zero();
};

Dense dense(const CentredHomography& at, const std::vector<Weighted>& pairs) {
  Dense sum;
  for (const auto& [pair, weight] : pairs) {
    const Eigen::Vector2d p = centred(pair.in_template, kWidth, kHeight);
    const auto J = HomographyStep::jacobian(at, p);
    const Seen s = seen(at, p);
    const Eigen::Vector2d r(pair.in_image.u - s.u, pair.in_image.v - s.v);
    sum.M += weight * J.transpose() * J;
    sum.b += weight * J.transpose() * r;
  }
  return sum;
}

TEST(HomographyStep, IsTheSolutionOfTheNormalEquations) {
  test::Random random("dense");
  for (const double perspective : {0.0, 1.0, 1e5}) {
    const Homography H = some_view(random);
    const auto pairs = weighted_pairs(H, 20, 3, random);
    const CentredHomography at = centred(some_view(random), kWidth, kHeight);
    const HomographyStep step = step_of(at, pairs);
    Dense system = dense(at, pairs);
    EXPECT_LT((step.information() - system.M).norm() / system.M.norm(), 1e-12);
    for (int k = 6; k < 8; ++k) {
      system.M(k, k) += perspective;
      system.b[k] -= perspective * at.G(2, k - 6);
    }
    const Eigen::Matrix<double, 8, 1> d = system.M.ldlt().solve(system.b);
    const auto next = step.taken(perspective);
    ASSERT_TRUE(next);
    for (int k = 0; k < 8; ++k) {
      const double expected = at.G(k / 3, k % 3) + d[k];
      EXPECT_NEAR(next->G(k / 3, k % 3), expected, 1e-6 * (1 + std::abs(expected)));
    }
    EXPECT_DOUBLE_EQ(next->G(2, 2), 1);
  }
}

TEST(HomographyStep, ConvergesToExactPairs) {
  test::Random random("converges");
  for (int i = 0; i < 10; ++i) {
    const Homography H = some_view(random);
    const auto pairs = weighted_pairs(H, 10, 0, random);
    CentredHomography model = centred(H, kWidth, kHeight);
    model.G.topRows<2>() += Eigen::Matrix<double, 2, 3>::Constant(random.uniform(-5, 5));
    for (int k = 0; k < 6; ++k) {
      const auto next = step_of(model, pairs).taken(0);
      ASSERT_TRUE(next);
      model = *next;
    }
    EXPECT_LT((model.G - centred(H, kWidth, kHeight).G).norm(), 1e-7);
  }
}

TEST(HomographyStep, IsAffineWhenPerspectiveIsKnownToBeNone) {
  test::Random random("affine");
  const auto pairs = weighted_pairs(some_view(random), 20, 1, random);
  const auto next = step_of({}, pairs).taken(1e15);
  ASSERT_TRUE(next);
  EXPECT_LT(next->G.row(2).head<2>().norm(), 1e-6);
}

TEST(HomographyStep, IsEmptyForPairsThatDetermineNothing) {
  test::Random random("nothing");
  const Homography H = some_view(random);
  const CentredHomography at = centred(H, kWidth, kHeight);
  EXPECT_FALSE(step_of(at, {}).taken(0));
  EXPECT_FALSE(step_of(at, weighted_pairs(H, 3, 0, random)).taken(0));
  EXPECT_FALSE(step_of(at, weighted_pairs(H, 2, 0, random)).taken(1));
  EXPECT_TRUE(step_of(at, weighted_pairs(H, 3, 0, random)).taken(1));
  auto pairs = weighted_pairs(H, 20, 0, random);
  for (auto& weighted : pairs) {  // all on a line
    weighted.pair.in_template.v = weighted.pair.in_template.u / 2;
    weighted.pair.in_image = H * weighted.pair.in_template;
  }
  EXPECT_FALSE(step_of(at, pairs).taken(0));
  EXPECT_FALSE(step_of(at, std::vector<Weighted>(20, pairs[0])).taken(0));
  pairs = weighted_pairs(H, 20, 0, random);
  pairs[4].pair.in_template.u = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(step_of(at, pairs).taken(0));
}

}  // namespace
}  // namespace kestrel

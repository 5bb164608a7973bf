#include "kestrel/vision/corner_covariance.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "kestrel/vision/homography_step.hpp"

#include "support/pixel_pairs.hpp"
#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel {
namespace {

constexpr double kWidth = test::kGridWidth;
constexpr double kHeight = test::kGridHeight;
using Corners = Eigen::Matrix<double, 8, 1>;

using test::grid;
using test::noisy;

/// The least-squares fit of reprojection, from near it.
Homography fitted(const Homography& near, const std::vector<PixelPair>& pairs) {
  CentredHomography model = centred(near, kWidth, kHeight);
  for (int k = 0; k < 4; ++k) {
    HomographyStep step(model);
    for (const PixelPair& p : pairs) {
      step.add(centred(p.in_template, kWidth, kHeight), p.in_image, 1);
    }
    model = *step.taken(0);
  }
  return *uncentred(model, kWidth, kHeight);
}

Corners corners_of(const Homography& H) {
  Corners c;
  Eigen::Index row = 0;
  for (const Pixel& p : outline(H, kWidth, kHeight)) {
    c[row++] = p.u;
    c[row++] = p.v;
  }
  return c;
}

TEST(CornerCovariance, IsWhatRepeatedFitsScatterBy) {
  test::Random random("scatter");
  for (const test::Motion& motion : {test::Motion{1, 0, 0, 0}, test::Motion{1.6, 0.7, 0.7, 0.4}}) {
    const Homography H = test::moved(motion, {80, 60}, {300, 200});
    const auto exact = grid(H, 0.1, 0.8);
    const double sigma = 0.8;
    const int repeats = 1000;
    CornerCovariance scatter = CornerCovariance::Zero();
    CornerCovariance predicted = CornerCovariance::Zero();
    for (int i = 0; i < repeats; ++i) {
      const auto pairs = noisy(exact, sigma, random);
      const Homography fit = fitted(H, pairs);
      const Corners d = corners_of(fit) - corners_of(H);
      scatter += d * d.transpose() / repeats;
      predicted += corner_covariance(fit, pairs, kWidth, kHeight, 0.01) / repeats;
    }
    // In coordinates where the prediction is the identity, the scatter is one but for sampling: an
    // element errs by sqrt(2 / repeats) = 0.045, the extreme of eight eigenvalues by up to
    // 2 sqrt(8 / repeats) = 0.18 (Marchenko & Pastur 1967); some more for the second order.
    const Eigen::LLT<CornerCovariance> factor(predicted);
    const CornerCovariance half = factor.matrixL().solve(scatter);
    const CornerCovariance whitened = factor.matrixL().solve(half.transpose());
    const Eigen::SelfAdjointEigenSolver<CornerCovariance> solver(whitened);
    EXPECT_GT(solver.eigenvalues().minCoeff(), 0.77);
    EXPECT_LT(solver.eigenvalues().maxCoeff(), 1.25);
  }
}

TEST(CornerCovariance, IsSymmetricAndPositive) {
  test::Random random("positive");
  const Homography H = test::moved({1.3, 1, 0.5, 0.2}, {80, 60}, {300, 200});
  const CornerCovariance C =
      corner_covariance(H, noisy(grid(H, 0, 1), 1, random), kWidth, kHeight, 0.5);
  EXPECT_EQ(C, C.transpose());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<CornerCovariance>(C).eigenvalues().minCoeff(), 0);
}

TEST(CornerCovariance, NeverTrustsPairsBelowTheLeastNoise) {
  const Homography H = test::translation(50, 40);
  const auto pairs = grid(H, 0, 1);
  const CornerCovariance one = corner_covariance(H, pairs, kWidth, kHeight, 1);
  const CornerCovariance half = corner_covariance(H, pairs, kWidth, kHeight, 0.5);
  EXPECT_LT((one - 4 * half).norm() / one.norm(), 1e-12);
  // Thirty pairs all over the template fix a corner to about the noise of one of them.
  EXPECT_GT(one.trace() / 8, 0.1);
  EXPECT_LT(one.trace() / 8, 1);
}

TEST(CornerCovariance, IsInfiniteWhenThePairsDetermineNothing) {
  const Homography H = test::translation(50, 40);
  const auto is_huge = [&](const std::vector<PixelPair>& pairs) {
    return corner_covariance(H, pairs, kWidth, kHeight, 0.5).diagonal().minCoeff() > 1e6;
  };
  auto pairs = grid(H, 0, 1);
  EXPECT_FALSE(is_huge(pairs));
  EXPECT_TRUE(is_huge({}));
  EXPECT_TRUE(is_huge({pairs.begin(), pairs.begin() + 3}));
  EXPECT_TRUE(is_huge(std::vector<PixelPair>(20, pairs[7])));
  pairs[0].in_template.u = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(is_huge(pairs));
}

}  // namespace
}  // namespace kestrel

#include "kestrel/vision/outline_deviation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include "support/pixel_pairs.hpp"
#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel {
namespace {

constexpr double kWidth = test::kGridWidth;
constexpr double kHeight = test::kGridHeight;

using test::grid;
using test::noisy;

TEST(OutlineDeviation, IsWhatRepeatedFitsScatterBy) {
  test::Random random("scatter");
  for (const test::Motion& motion : {test::Motion{1, 0, 0, 0}, test::Motion{1.6, 0.7, 0.7, 0.4}}) {
    const Homography H = test::moved(motion, {80, 60}, {300, 200});
    const auto truth = outline(H, kWidth, kHeight);
    const double sigma = 1.2;
    const int repeats = 400;
    double scatter = 0;
    double predicted = 0;
    for (int i = 0; i < repeats; ++i) {
      const auto pairs = noisy(grid(H, 0.1, 0.8), sigma, random);
      const auto fit = fit_homography(pairs);
      ASSERT_TRUE(fit);
      const auto corners = outline(*fit, kWidth, kHeight);
      for (std::size_t c = 0; c < 4; ++c) {
        scatter += std::pow(distance(corners[c], truth[c]), 2) / (4 * repeats);
      }
      predicted += std::pow(outline_deviation_px(*fit, pairs, kWidth, kHeight), 2) / repeats;
    }
    // 400 repeats of 8 numbers tell a standard deviation to 2 %; the fit is algebraic, not the
    // least squares of reprojection that the formula holds for: a few per cent more.
    EXPECT_NEAR(std::sqrt(scatter / predicted), 1, 0.1);
  }
}

using Derivative = Eigen::Matrix<double, 2, 8>;

/// Central differences of a point's image by the eight elements of H other than the last.
Derivative differences(const Homography& H, const Pixel& p) {
  Derivative J;
  for (int k = 0; k < 8; ++k) {
    Homography more = H;
    Homography less = H;
    const double step = 1e-5 * std::max(1e-3, std::abs(H.H(k / 3, k % 3)));
    more.H(k / 3, k % 3) += step;
    less.H(k / 3, k % 3) -= step;
    const Pixel a = more * p;
    const Pixel b = less * p;
    J.col(k) << (a.u - b.u) / (2 * step), (a.v - b.v) / (2 * step);
  }
  return J;
}

TEST(OutlineDeviation, IsTheFormulaInOtherParameters) {
  // Parameters of H in pixels instead of scaled ones: the corners' covariance must not care.
  test::Random random("formula");
  for (int i = 0; i < 10; ++i) {
    const test::Motion motion{random.uniform(0.6, 1.6), random.uniform(-3, 3),
                              random.uniform(0.2, 0.9), random.uniform(0, 3)};
    const Homography truth = test::moved(motion, {70, 50}, {random.uniform(50, 400), 90});
    const auto pairs = noisy(grid(truth, 0.1, 0.8), 1.5, random);
    const auto H = fit_homography(pairs);
    ASSERT_TRUE(H);
    Eigen::MatrixXd A(60, 8);
    double residuals = 0;
    for (Eigen::Index k = 0; k < 30; ++k) {
      const PixelPair& pair = pairs[std::size_t(k)];
      A.middleRows<2>(2 * k) = differences(*H, pair.in_template);
      residuals += std::pow(distance(*H * pair.in_template, pair.in_image), 2);
    }
    const Eigen::VectorXd size = A.colwise().norm();  // pixels make a matrix of unlike columns
    const Eigen::MatrixXd scaled = A * size.cwiseInverse().asDiagonal();
    const Eigen::MatrixXd covariance = (scaled.transpose() * scaled).inverse();
    double sum = 0;
    for (const Pixel& corner : template_corners(kWidth, kHeight)) {
      const Eigen::MatrixXd J = differences(*H, corner) * size.cwiseInverse().asDiagonal();
      sum += (J * covariance * J.transpose()).trace();
    }
    const double expected = std::sqrt(residuals / (60 - 8) * sum / 4);
    EXPECT_NEAR(outline_deviation_px(*H, pairs, kWidth, kHeight) / expected, 1, 1e-4);
  }
}

TEST(OutlineDeviation, GrowsAsTheInliersCrowd) {
  const Homography H = test::translation(50, 40);
  double last = 0;
  for (const double part : {1.0, 0.6, 0.3, 0.15}) {
    const double deviation = outline_deviation_px(H, grid(H, 0, part), kWidth, kHeight);
    EXPECT_GT(deviation, 1.5 * last);
    last = deviation;
  }
  EXPECT_GT(last, 10);  // perfect agreement of 30 pairs in one corner says little of the others
}

TEST(OutlineDeviation, NeverTrustsPairsBelowHalfAPixel) {
  const Homography H = test::translation(50, 40);
  const auto pairs = grid(H, 0, 1);
  const double perfect = outline_deviation_px(H, pairs, kWidth, kHeight);
  EXPECT_GT(perfect, 0.25);
  EXPECT_LT(perfect, 0.75);
  test::Random random("floor");
  EXPECT_NEAR(outline_deviation_px(H, noisy(pairs, 0.2, random), kWidth, kHeight), perfect, 1e-9);
}

TEST(OutlineDeviation, IsProportionalToTheNoise) {
  const Homography H = test::translation(50, 40);
  test::Random a("proportional");
  test::Random b("proportional");
  const double one = outline_deviation_px(H, noisy(grid(H, 0, 1), 1, a), kWidth, kHeight);
  const double three = outline_deviation_px(H, noisy(grid(H, 0, 1), 3, b), kWidth, kHeight);
  EXPECT_NEAR(three / one, 3, 1e-9);
}

TEST(OutlineDeviation, IsInfiniteWhenThePairsDetermineNothing) {
  const Homography H = test::translation(50, 40);
  const auto huge = [&](const std::vector<PixelPair>& pairs) {
    return !(outline_deviation_px(H, pairs, kWidth, kHeight) < 1e4);
  };
  auto pairs = grid(H, 0, 1);
  EXPECT_TRUE(huge({}));
  EXPECT_TRUE(huge({pairs.begin(), pairs.begin() + 3}));
  EXPECT_TRUE(huge({pairs.begin(), pairs.begin() + 5}));  // one column of the grid
  EXPECT_TRUE(huge(std::vector<PixelPair>(20, pairs[7])));
  pairs[0].in_template.u = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(outline_deviation_px(H, pairs, kWidth, kHeight),
            std::numeric_limits<double>::infinity());
  Homography nonsense;
  nonsense.H(2, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(outline_deviation_px(nonsense, grid(H, 0, 1), kWidth, kHeight),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace kestrel

#include "kestrel/geometry/homography.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "support/random.hpp"

namespace kestrel {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kWidth = 320;
constexpr double kHeight = 240;

/// A map of the template to a quadrilateral of its size, shifted and bent, as a view would.
Homography any(test::Random& random) {
  Matrix3d H;
  const double a = random.uniform(-M_PI, M_PI);
  const double s = random.uniform(0.5, 2);
  H << s * std::cos(a), -s * std::sin(a) + random.uniform(-0.2, 0.2), random.uniform(-100, 400),
      s * std::sin(a), s * std::cos(a), random.uniform(-100, 400), random.uniform(-8e-4, 8e-4),
      random.uniform(-8e-4, 8e-4), 1;
  return {H};
}

Pixel in_template(test::Random& random) {
  return {random.uniform(0, kWidth - 1), random.uniform(0, kHeight - 1)};
}

std::vector<PixelPair> corner_pairs(const Homography& image_from_template) {
  std::vector<PixelPair> pairs;
  for (const Pixel& p : template_corners(kWidth, kHeight)) {
    pairs.push_back({p, image_from_template * p});
  }
  return pairs;
}

std::vector<PixelPair> pairs_of(const Homography& H, int count, test::Random& random) {
  std::vector<PixelPair> pairs = corner_pairs(H);
  while (int(pairs.size()) < count) {
    const Pixel p = in_template(random);
    pairs.push_back({p, H * p});
  }
  return pairs;
}

double worst_px(const Homography& a, const Homography& b) {
  double worst = 0;
  for (const Pixel& p : template_corners(kWidth, kHeight)) {
    worst = std::fmax(worst, distance(a * p, b * p));
  }
  return worst;
}

TEST(Homography, MapsAsEquationFour) {
  const Homography H{(Matrix3d() << 1, 2, 3, 4, 5, 6, 0.1, 0.2, 1).finished()};
  const Pixel p = H * Pixel{10, 20};
  EXPECT_NEAR(p.u, (10 + 40 + 3) / (1 + 4 + 1.0), 1e-15 * 100);
  EXPECT_NEAR(p.v, (40 + 100 + 6) / (1 + 4 + 1.0), 1e-15 * 100);
  const Pixel far = Homography{(Matrix3d() << 1, 0, 0, 0, 1, 0, 1, 0, 0).finished()} * Pixel{0, 5};
  EXPECT_FALSE(std::isfinite(far.u) && std::isfinite(far.v));
}

TEST(Homography, CornersAreThePixelCentresClockwise) {
  const auto c = template_corners(kWidth, kHeight);
  EXPECT_EQ(c[0].u, 0);
  EXPECT_EQ(c[1].u, 319);
  EXPECT_EQ(c[2].v, 239);
  EXPECT_EQ(c[3].u, 0);
  EXPECT_EQ(c[3].v, 239);
  EXPECT_EQ(signed_area(c), 319 * 239);
  const auto o = outline({Matrix3d::Identity()}, kWidth, kHeight);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(distance(o[i], c[i]), 0);
}

TEST(Homography, FitRecoversTheMapFromFourPairsAndFromMany) {
  test::Random random("fit");
  for (const int count : {4, 5, 20, 100}) {
    for (int i = 0; i < 100; ++i) {
      const Homography truth = any(random);
      const auto fit = fit_homography(pairs_of(truth, count, random));
      ASSERT_TRUE(fit);
      EXPECT_LT(worst_px(*fit, truth), 1e-9) << count;
      EXPECT_EQ(fit->H(2, 2), 1);
    }
  }
}

// Eq. (5) of the paper by substitution: the fit's eight parameters solve both rows of each pair.
TEST(Homography, FitOfFourPairsSolvesEquationFive) {
  test::Random random("equation five");
  for (int i = 0; i < 100; ++i) {
    std::vector<PixelPair> pairs = corner_pairs(any(random));
    for (PixelPair& p : pairs) p.in_image.u += random.normal();
    const auto fit = fit_homography(pairs);
    ASSERT_TRUE(fit);
    const double a = fit->H(0, 0), b = fit->H(0, 1), c = fit->H(0, 2), d = fit->H(1, 0),
                 e = fit->H(1, 1), f = fit->H(1, 2), g = fit->H(2, 0), h = fit->H(2, 1);
    for (const auto& [from, to] : pairs) {
      const double x = from.u, y = from.v, xp = to.u, yp = to.v;
      EXPECT_NEAR(a * x + b * y + c - g * x * xp - h * y * xp, xp, 1e-8);
      EXPECT_NEAR(d * x + e * y + f - g * x * yp - h * y * yp, yp, 1e-8);
    }
  }
}

// The same four pairs twice over go through the least squares, and must give the same map.
TEST(Homography, FourPairsAndLeastSquaresAgree) {
  test::Random random("two ways");
  for (int i = 0; i < 100; ++i) {
    std::vector<PixelPair> pairs = corner_pairs(any(random));
    for (PixelPair& p : pairs) p.in_image.v += 3 * random.normal();
    std::vector<PixelPair> twice = pairs;
    twice.insert(twice.end(), pairs.begin(), pairs.end());
    const auto exact = fit_homography(pairs);
    const auto fitted = fit_homography(twice);
    ASSERT_TRUE(exact && fitted);
    EXPECT_LT(worst_px(*exact, *fitted), 1e-9);
  }
}

TEST(Homography, FitAveragesNoise) {
  test::Random random("noise");
  for (const int count : {20, 200}) {
    double squares = 0;
    constexpr int kTrials = 200;
    for (int i = 0; i < kTrials; ++i) {
      const Homography truth = any(random);
      std::vector<PixelPair> pairs;
      for (int k = 0; k < count; ++k) {
        const Pixel p = in_template(random);
        const Pixel q = truth * p;
        pairs.push_back({p, {q.u + 0.5 * random.normal(), q.v + 0.5 * random.normal()}});
      }
      const auto fit = fit_homography(pairs);
      ASSERT_TRUE(fit);
      const Pixel middle{kWidth / 2, kHeight / 2};
      squares += std::pow(distance(*fit * middle, truth * middle), 2);
    }
    // In the middle of uniformly spread points the map is at least as well known as a mean of them
    // (0.5 sqrt(2 / n)) and, with the bend fitted too, no worse than twice that.
    const double of_a_mean = 0.5 * std::sqrt(2.0 / count);
    EXPECT_GT(std::sqrt(squares / kTrials), 0.9 * of_a_mean);
    EXPECT_LT(std::sqrt(squares / kTrials), 2 * of_a_mean);
  }
}

TEST(Homography, FitDoesNotDependOnOrderNorUnits) {
  test::Random random("invariance");
  for (int i = 0; i < 50; ++i) {
    for (const std::size_t count : {4, 12}) {
      std::vector<PixelPair> pairs = pairs_of(any(random), int(count), random);
      for (PixelPair& p : pairs) p.in_image.u += random.normal();
      const auto fit = fit_homography(pairs);
      std::vector<PixelPair> moved;
      for (const PixelPair& p : pairs) {
        moved.push_back({{p.in_template.u / 100 - 3, p.in_template.v / 100 + 5},
                         {p.in_image.u * 7 + 1000, p.in_image.v * 7 - 2000}});
      }
      std::rotate(moved.begin(), moved.begin() + 1, moved.end());
      const auto fit_moved = fit_homography(moved);
      ASSERT_TRUE(fit && fit_moved);
      for (const Pixel& c : template_corners(kWidth, kHeight)) {
        const Pixel there = *fit_moved * Pixel{c.u / 100 - 3, c.v / 100 + 5};
        EXPECT_LT(distance(*fit * c, {(there.u - 1000) / 7, (there.v + 2000) / 7}), 1e-7);
      }
    }
  }
}

/// The four corners with one pair moved, as they are and twice over (the least squares).
void expect_no_fit(const std::vector<PixelPair>& pairs, const char* what) {
  EXPECT_FALSE(fit_homography(pairs)) << what;
  std::vector<PixelPair> twice = pairs;
  twice.insert(twice.end(), pairs.begin(), pairs.end());
  EXPECT_FALSE(fit_homography(twice)) << what << ", least squares";
}

TEST(Homography, NoFitFromDegeneratePositions) {
  test::Random random("degenerate");
  const std::vector<PixelPair> good = corner_pairs(any(random));
  ASSERT_TRUE(fit_homography(good));
  for (const auto side : {&PixelPair::in_template, &PixelPair::in_image}) {
    for (std::size_t i = 0; i < 4; ++i) {
      std::vector<PixelPair> pairs = good;
      const Pixel a = pairs[(i + 1) % 4].*side;
      const Pixel b = pairs[(i + 2) % 4].*side;
      pairs[i].*side = {a.u + 0.3 * (b.u - a.u), a.v + 0.3 * (b.v - a.v)};
      expect_no_fit(pairs, "three on a line");
      pairs[i].*side = a;
      expect_no_fit(pairs, "two at one place");
    }
    std::vector<PixelPair> pairs = good;
    for (PixelPair& p : pairs) p.*side = {5, 5};
    expect_no_fit(pairs, "all at one place");
    for (std::size_t i = 0; i < 4; ++i) pairs[i].*side = {double(i), 2.0 * double(i)};
    expect_no_fit(pairs, "all on a line");
  }
}

TEST(Homography, NoFitFromManyPointsOnALineButOne) {
  test::Random random("line but one");
  const Homography truth = any(random);
  std::vector<PixelPair> pairs;
  for (int i = 0; i < 30; ++i) {
    const Pixel p{10.0 * i, 3.0 * i};
    pairs.push_back({p, truth * p});
  }
  pairs.push_back({{5, 200}, truth * Pixel{5, 200}});
  EXPECT_FALSE(fit_homography(pairs));
}

TEST(Homography, NoFitFromTooFewOrNonFinitePoints) {
  test::Random random("bad points");
  const std::vector<PixelPair> good = pairs_of(any(random), 6, random);
  EXPECT_FALSE(fit_homography({}));
  EXPECT_FALSE(fit_homography({good.begin(), good.begin() + 3}));
  for (const std::size_t count : {4, 6}) {
    for (const double bad : {kNan, std::numeric_limits<double>::infinity()}) {
      for (const auto side : {&PixelPair::in_template, &PixelPair::in_image}) {
        std::vector<PixelPair> pairs(good.begin(), good.begin() + std::ptrdiff_t(count));
        (pairs[2].*side).v = bad;
        EXPECT_FALSE(fit_homography(pairs));
      }
    }
    std::vector<PixelPair> pairs(good.begin(), good.begin() + std::ptrdiff_t(count));
    pairs[0].in_image.u = pairs[1].in_image.u = 1.7e308;  // their sum overflows
    EXPECT_FALSE(fit_homography(pairs));
  }
}

TEST(Homography, SignedAreaIsPositiveClockwiseOnTheScreen) {
  EXPECT_EQ(signed_area({{{0, 0}, {2, 0}, {2, 3}, {0, 3}}}), 6);
  EXPECT_EQ(signed_area({{{0, 0}, {0, 3}, {2, 3}, {2, 0}}}), -6);
  EXPECT_EQ(signed_area({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}), 0);  // a bow tie of equal halves
}

/// The map that takes the template's corners to these points.
Homography onto(const std::array<Pixel, 4>& corners) {
  const auto from = template_corners(kWidth, kHeight);
  std::vector<PixelPair> pairs;
  for (std::size_t i = 0; i < 4; ++i) pairs.push_back({from[i], corners[i]});
  return fit_homography(pairs).value();
}

bool plausible(const Homography& H) { return is_plausible(H, kWidth, kHeight); }

TEST(Homography, PlausibleAreTheViewsOfAPlaneFromItsFront) {
  test::Random random("plausible");
  for (int i = 0; i < 100; ++i) {
    const Homography H = any(random);
    EXPECT_TRUE(plausible(H));
    EXPECT_TRUE(plausible({-3 * H.H}));  // the scale of H means nothing
  }
}

TEST(Homography, ImplausibleAreMirroredFoldedAndBehind) {
  EXPECT_TRUE(plausible(onto({{{10, 10}, {200, 20}, {210, 180}, {5, 190}}})));
  EXPECT_FALSE(plausible(onto({{{200, 20}, {10, 10}, {5, 190}, {210, 180}}}))) << "mirrored";
  EXPECT_FALSE(plausible(onto({{{10, 10}, {210, 180}, {200, 20}, {5, 190}}}))) << "bow tie";
  EXPECT_FALSE(plausible(onto({{{10, 10}, {200, 20}, {60, 60}, {5, 190}}}))) << "not convex";
  Matrix3d H = Matrix3d::Identity();
  H(2, 0) = -1.0 / 319;
  EXPECT_FALSE(plausible({H})) << "a side at infinity";
  H(2, 0) = -1.0 / 200;
  EXPECT_FALSE(plausible({H})) << "a side behind the camera";
}

TEST(Homography, ImplausibleAreTinyHugeAndThinOutlines) {
  const auto scaled = [](double s, double t) {
    return Homography{Vector3d(s, t, 1).asDiagonal().toDenseMatrix()};
  };
  EXPECT_TRUE(plausible(scaled(1.01 / 8, 1.01 / 8)));
  EXPECT_FALSE(plausible(scaled(0.99 / 8, 0.99 / 8)));
  EXPECT_TRUE(plausible(scaled(7.9, 7.9)));
  EXPECT_FALSE(plausible(scaled(8.1, 8.1)));
  EXPECT_TRUE(plausible(scaled(1, 6.01 / 239)));
  EXPECT_FALSE(plausible(scaled(1, 5.99 / 239)));
  EXPECT_FALSE(plausible(scaled(0, 0)));
}

TEST(Homography, ImplausibleIsWhatIsNotFinite) {
  for (const double bad : {kNan, std::numeric_limits<double>::infinity()}) {
    for (int i = 0; i < 9; ++i) {
      Matrix3d H = Matrix3d::Identity();
      H(i) = bad;
      EXPECT_FALSE(plausible({H}));
    }
  }
  EXPECT_FALSE(plausible({Matrix3d::Zero()}));
  EXPECT_FALSE(is_plausible({}, 1, 1));
}

/// The homography of an outline of a template of kWidth x kHeight.
std::optional<Homography> from_outline(const std::array<Pixel, 4>& corners) {
  return homography_from_outline(corners, kWidth, kHeight);
}

TEST(Homography, FromOutlineInvertsOutline) {
  test::Random random("from outline");
  for (int i = 0; i < 200; ++i) {
    const Homography truth = any(random);
    const auto corners = outline(truth, kWidth, kHeight);
    const auto H = from_outline(corners);
    ASSERT_TRUE(H);
    const auto again = outline(*H, kWidth, kHeight);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_LT(distance(again[k], corners[k]), 1e-9);
    // The corners leave no freedom: the map inside is the same.
    const Pixel p = in_template(random);
    EXPECT_LT(distance(*H * p, truth * p), 1e-9);
    EXPECT_EQ(H->H(2, 2), 1);
  }
}

TEST(Homography, FromOutlineAgreesWithTheFitOfFourPairs) {
  test::Random random("from any outline");
  for (int i = 0; i < 100; ++i) {
    auto corners = outline(any(random), kWidth, kHeight);
    for (Pixel& p : corners) p = {p.u + 5 * random.normal(), p.v + 5 * random.normal()};
    std::vector<PixelPair> pairs;
    for (std::size_t k = 0; k < 4; ++k) {
      pairs.push_back({template_corners(kWidth, kHeight)[k], corners[k]});
    }
    const auto fit = fit_homography(pairs);
    const auto H = from_outline(corners);
    ASSERT_TRUE(fit && H);
    EXPECT_LT(worst_px(*H, *fit), 1e-8);
    EXPECT_LT((H->H - fit->H).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(Homography, NoneFromADegenerateOutline) {
  const std::array<Pixel, 4> good{{{10, 20}, {300, 30}, {290, 250}, {20, 240}}};
  ASSERT_TRUE(from_outline(good));
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<Pixel, 4> corners = good;
    const Pixel a = good[(i + 1) % 4];
    for (const std::size_t other : {2, 3}) {
      const Pixel b = good[(i + other) % 4];
      corners[i] = {a.u + 0.3 * (b.u - a.u), a.v + 0.3 * (b.v - a.v)};
      EXPECT_FALSE(from_outline(corners)) << "three on a line, " << i << " " << other;
    }
    corners[i] = a;
    EXPECT_FALSE(from_outline(corners)) << "two at one place, " << i;
    corners = good;
    corners[i].v = kNan;
    EXPECT_FALSE(from_outline(corners));
    corners[i].v = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(from_outline(corners));
  }
  EXPECT_FALSE(from_outline({{{5, 5}, {5, 5}, {5, 5}, {5, 5}}}));
  EXPECT_FALSE(homography_from_outline(good, 1, 1));
}

}  // namespace
}  // namespace kestrel

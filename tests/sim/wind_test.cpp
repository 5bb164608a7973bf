#include "kestrel/sim/wind.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

WindOptions turbulent() {
  WindOptions o;
  o.mean_ned_m_s = {5, 0, 0};
  o.turbulence_m_s = 8;
  o.altitude_m = 10;
  return o;
}

// h = 32.8 ft: 0.177 + 0.000823 h = 0.2040; L_u = 32.8 / 0.2040^1.2 = 221.0 ft = 67.4 m.
TEST(Wind, HasTheTurbulenceOfTheStandard) {
  const Turbulence t = turbulence(turbulent());
  EXPECT_NEAR(t.sigma_m_s.z(), 0.8, 1e-12);
  EXPECT_NEAR(t.sigma_m_s.x(), 0.8 / std::pow(0.204, 0.4), 1e-4);
  EXPECT_NEAR(t.length_m.x(), 67.4, 0.1);
  EXPECT_EQ(t.length_m.y(), t.length_m.x());
  EXPECT_EQ(t.length_m.z(), 10);
}

// A stretch of T = 15 000 s holds about T V / (2 L) = 560 to 3 800 independent values: standard
// deviations are known to 3 %, and 10 % is more than three times that; so is 0.3 for a mean.
TEST(Wind, BlowsWithItsVarianceAboutItsMean) {
  const double h = 0.1;
  Wind wind(turbulent(), 3, h);
  const int n = 150000;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d d = wind.next() - Eigen::Vector3d(5, 0, 0);
    sum += d;
    squares += d.cwiseProduct(d);
  }
  const Turbulence t = turbulence(turbulent());
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(sum[axis] / n, 0, 0.3) << axis;
    EXPECT_NEAR(std::sqrt(squares[axis] / n) / t.sigma_m_s[axis], 1, 0.10) << axis;
  }
}

// Along the wind the correlation falls as e^(-V t / L); across it as (1 - V t / (2 L)) e^(-V t /
// L).
TEST(Wind, ForgetsAtTheRateOfTheStandard) {
  const double h = 0.5;
  Wind wind(turbulent(), 4, h);
  std::vector<Eigen::Vector3d> all;
  for (int i = 0; i < 100000; ++i) all.push_back(wind.next() - Eigen::Vector3d(5, 0, 0));
  const Turbulence t = turbulence(turbulent());
  const auto correlation = [&](int axis, std::size_t lag) {
    double sum = 0;
    for (std::size_t i = lag; i < all.size(); ++i) sum += all[i][axis] * all[i - lag][axis];
    return sum / double(all.size() - lag) / (t.sigma_m_s[axis] * t.sigma_m_s[axis]);
  };
  const double x = 5 * 5.0 / t.length_m.x();  // ten steps
  EXPECT_NEAR(correlation(0, 10), std::exp(-x), 0.08);
  EXPECT_NEAR(correlation(1, 10), (1 - x / 2) * std::exp(-x), 0.08);
}

TEST(Wind, TurnsWithItsMean) {
  WindOptions east = turbulent();
  east.mean_ned_m_s = {0, 5, 0};
  Wind a(turbulent(), 5, 0.1);
  Wind b(east, 5, 0.1);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d x = a.next(), y = b.next();
    EXPECT_NEAR(x.x(), y.y(), 1e-12);
    EXPECT_NEAR(x.y(), -y.x(), 1e-12);
    EXPECT_NEAR(x.z(), y.z(), 1e-12);
  }
}

TEST(Wind, HoldsOneGust) {
  WindOptions o;
  o.gust_ned_m_s = {0, 4, 0};
  o.gust_start_s = 1;
  o.gust_duration_s = 2;
  Wind wind(o, 1, 0.5);
  const double expected[] = {0, 0, 0, 2, 4, 2, 0, 0};
  for (const double value : expected) EXPECT_NEAR(wind.next().y(), value, 1e-12);
}

TEST(Wind, IsStillByDefaultAndRepeats) {
  Wind still({}, 1, 0.1);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(still.next(), Eigen::Vector3d(0, 0, 0));
  Wind a(turbulent(), 7, 0.1), b(turbulent(), 7, 0.1), c(turbulent(), 8, 0.1);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d x = a.next();
    EXPECT_EQ(x, b.next());
    EXPECT_NE(x, c.next());
  }
}

TEST(Wind, RefusesOptionsOutOfRange) {
  WindOptions o;
  o.altitude_m = 1;
  EXPECT_THROW(Wind(o, 1, 0.1), std::invalid_argument);
  EXPECT_THROW(Wind({}, 1, 0), std::invalid_argument);
  o = {};
  o.turbulence_m_s = -1;
  EXPECT_THROW(o.check(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

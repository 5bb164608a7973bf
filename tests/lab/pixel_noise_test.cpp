#include "kestrel/lab/pixel_noise.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(PixelNoise, IsBoxMullerOnMersenneTwister) {
  std::mt19937_64 engine(42);
  const double u1 = std::ldexp(double(engine() >> 11), -53);
  const double u2 = std::ldexp(double(engine() >> 11), -53);
  const double radius = std::sqrt(-2 * std::log(1 - u1));
  PixelNoise noise(42, 0.5);
  const Pixel first = noise.next();
  EXPECT_DOUBLE_EQ(first.u, 0.5 * radius * std::cos(2 * M_PI * u2));
  EXPECT_DOUBLE_EQ(first.v, 0.5 * radius * std::sin(2 * M_PI * u2));
}

TEST(PixelNoise, HasTheDeviationAskedFor) {
  PixelNoise noise(1, 2);
  double sum = 0;
  double squares = 0;
  double products = 0;
  constexpr int kPairs = 20000;
  for (int i = 0; i < kPairs; ++i) {
    const Pixel p = noise.next();
    sum += p.u + p.v;
    squares += p.u * p.u + p.v * p.v;
    products += p.u * p.v;
  }
  // Five standard deviations of each estimate: 2/sqrt(40000), sqrt(2)*4/sqrt(40000), 4/sqrt(20000).
  EXPECT_NEAR(sum / (2 * kPairs), 0, 0.05);
  EXPECT_NEAR(squares / (2 * kPairs), 4, 0.15);
  EXPECT_NEAR(products / kPairs, 0, 0.15);
}

TEST(PixelNoise, IsZeroWithoutDeviation) {
  PixelNoise noise(42, 0);
  const Pixel p = noise.next();
  EXPECT_EQ(p.u, 0);
  EXPECT_EQ(p.v, 0);
}

}  // namespace
}  // namespace kestrel

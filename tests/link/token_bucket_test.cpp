#include "kestrel/link/token_bucket.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

TEST(TokenBucket, GivesAtMostItsBurstAndRateInAnySpan) {
  test::Random random("bucket");
  const FlowLimit limit{100, 20};
  TokenBucket bucket(limit);
  std::vector<double> taken_s;
  double now_s = 5;
  for (int i = 0; i < 4000; ++i) {
    now_s += random.integer(0, 9) == 0 ? random.uniform(0, 0.3) : random.uniform(0, 0.004);
    if (bucket.take(now_s)) taken_s.push_back(now_s);
  }
  for (std::size_t i = 0; i < taken_s.size(); i += 7) {
    for (std::size_t k = i; k < taken_s.size(); ++k) {
      // One part in 1e9 for the sums of the clock.
      EXPECT_LE(double(k - i + 1),
                limit.burst + limit.frames_per_s * (taken_s[k] - taken_s[i]) + 1e-6);
    }
  }
}

TEST(TokenBucket, NeverHoldsUpWhoKeepsToTheRate) {
  TokenBucket bucket({100, 1});
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(bucket.take(7 + 0.0101 * i));
}

TEST(TokenBucket, IsEmptyAfterItsBurstAndFillsInTime) {
  TokenBucket bucket({10, 3});
  EXPECT_TRUE(bucket.take(0) && bucket.take(0) && bucket.take(0));
  EXPECT_FALSE(bucket.take(0));
  EXPECT_FALSE(bucket.take(0.09));
  EXPECT_TRUE(bucket.take(0.11));
  EXPECT_FALSE(bucket.take(0.11));
  EXPECT_TRUE(bucket.take(100) && bucket.take(100) && bucket.take(100));
  EXPECT_FALSE(bucket.take(100));
}

TEST(TokenBucket, IsNotFilledByAClockThatStandsOrIsNone) {
  TokenBucket bucket({10, 1});
  EXPECT_TRUE(bucket.take(50));
  for (const double odd : {49.0, -1e9, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(bucket.take(odd)) << odd;
  }
  EXPECT_TRUE(bucket.take(50.2));
}

}  // namespace
}  // namespace kestrel

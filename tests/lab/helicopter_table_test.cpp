// The gain limits of the lateral loop, printed and held against the published table.
#include <cstdio>

#include <gtest/gtest.h>

#include "kestrel/lab/helicopter_margins.hpp"

#include "lab/support/lateral_loop.hpp"

namespace kestrel {
namespace {

// Published limits are 0.5 to 1.3 % below those of the eigenvalues; but the last, 1.80/s at 1.93 s
// per command without latency. There the vertical loop is the first to go (1.747/s, tau_z = 0.4 s,
// by hand), the lateral one stands until 2.005/s, and which of them a flight shows depends on how
// long it is: 1.80/s is in between, and so is what is found here.
TEST(HelicopterTable, GainLimits) {
  const std::pair<double, double> published[] = {{5.46, 5.46}, {4.65, 5.46}, {3.65, 5.46},
                                                 {2.81, 5.46}, {2.17, 2.17}, {1.16, 2.49},
                                                 {.874, 2.17}, {.482, 1.80}};
  const std::vector<GainLimitRow> table = gain_limit_table();
  ASSERT_EQ(table.size(), std::size(published));
  std::puts("period  latency  limit  predicted  (1/s)  published");
  for (std::size_t i = 0; i < table.size(); ++i) {
    const GainLimitRow& row = table[i];
    const double limit = row.limit_per_s.value_or(-1);
    const double predicted = row.predicted_limit_per_s.value_or(-1);
    std::printf("%5.3f s  %5.3f s  %6.4f  %6.4f  %5.3f  %5.3f\n",
                row.period_frames * kHelicopterFrame_s, row.delay_frames * kHelicopterFrame_s,
                limit, predicted, published[i].first, published[i].second);
    EXPECT_NEAR(limit, published[i].first, 0.015 * limit);
    // A run of 100 commands tells growth from decay to 1 %.
    EXPECT_NEAR(limit, test::lateral_gain_limit_oracle(row.period_frames, row.delay_frames),
                0.01 * limit);
    const double without_latency = test::lateral_gain_limit_oracle(row.period_frames, 0);
    if (row.period_frames == 58) {
      EXPECT_GT(predicted, 1.74);
      EXPECT_LT(predicted, without_latency);
      continue;
    }
    EXPECT_NEAR(predicted, published[i].second, 0.015 * predicted);
    EXPECT_NEAR(predicted, without_latency, 0.01 * predicted);
  }
}

}  // namespace
}  // namespace kestrel

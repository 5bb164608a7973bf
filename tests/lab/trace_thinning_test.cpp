#include "kestrel/lab/trace_thinning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "lab/made_up_report.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

/// The largest miss of straight lines through the kept rows, over the channel's range.
double largest_miss(const std::vector<double>& t, const std::vector<double>& v,
                    const std::vector<std::size_t>& rows) {
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  double worst = 0;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const std::size_t a = rows[k - 1];
    const std::size_t b = rows[k];
    for (std::size_t i = a; i <= b; ++i) {
      const double line = v[a] + (v[b] - v[a]) * (t[i] - t[a]) / (t[b] - t[a]);
      worst = std::max(worst, std::abs(line - v[i]));
    }
  }
  return worst / (*high - *low);
}

TEST(KeptRows, LinesThroughThemMissLittle) {
  test::Random random("kept_rows");
  std::vector<double> t;
  TraceChannel decay{"vx_m_s", {}, 2e-4};
  TraceChannel wave{"tx_m", {}, 5e-4};
  for (int k = 0; k < 1500; ++k) {
    t.push_back(k / 30.0);
    decay.values.push_back(3 * std::exp(-t.back()));
    wave.values.push_back(std::sin(t.back()) * std::exp(-0.2 * t.back()));
  }
  const auto rows = kept_rows(t, {decay, wave}, 400);
  EXPECT_LT(rows.size(), 100u);
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
  EXPECT_EQ(rows.front(), 0u);
  EXPECT_EQ(rows.back(), 1499u);
  EXPECT_LE(largest_miss(t, decay.values, rows), 0.005 + 1e-9);
  EXPECT_LE(largest_miss(t, wave.values, rows), 0.005 + 1e-9);
}

TEST(KeptRows, AreFewAlsoForNoise) {
  test::Random random("kept_rows.noise");
  std::vector<double> t;
  TraceChannel noise{"vx_m_s", {}, 2e-4};
  for (int k = 0; k < 900; ++k) {
    t.push_back(k);
    noise.values.push_back(random.uniform(-1, 1));
  }
  EXPECT_EQ(kept_rows(t, {noise}, 120).size(), 120u);
}

TEST(KeptRows, AGapKeepsItsPlace) {
  TraceChannel gap{"vx_m_s", std::vector<double>(50, 1.0), 2e-4};
  std::vector<double> t;
  for (int k = 0; k < 50; ++k) t.push_back(k);
  for (int k = 20; k < 30; ++k) gap.values[std::size_t(k)] = kNan;
  const auto rows = kept_rows(t, {gap}, 50);
  for (const std::size_t row : {19u, 20u, 29u, 30u})
    EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), row)) << row;
  EXPECT_LT(rows.size(), 10u);
}

TEST(KeptRows, OfNothingAreNone) {
  EXPECT_TRUE(kept_rows({}, {}, 10).empty());
  EXPECT_EQ(kept_rows({1}, {}, 10), (std::vector<std::size_t>{0}));
  EXPECT_EQ(kept_rows({1, 1, 1}, {{"tx_m", {0, 5, 0}, 1e-3}}, 10).size(), 3u);
}

TEST(DrawnChannels, AreThoseThatAreDrawnAndFinite) {
  RunTrace trace = test::made_up_run("S", "cur", "", 3).trace;
  trace.rows[0][2] = 0;        // error_norm
  trace.rows[1][3] = 1e300;    // u0_px
  trace.rows[2][10] = 1 / 0.;  // condition
  std::vector<std::string> names;
  for (const TraceChannel& channel : drawn_channels(trace)) {
    names.push_back(channel.column);
    for (const double value : channel.values) EXPECT_LE(std::abs(value), 1e5) << channel.column;
    if (channel.column == "error_norm") {
      EXPECT_EQ(channel.values[0], -8);
    }
  }
  EXPECT_EQ(names, (std::vector<std::string>{"error_norm", "u0_px", "v0_px", "vx_m_s", "tx_m",
                                             "ty_m", "tz_m", "condition", "sigma_min", "s1"}));
}

TEST(Thinned, KeepsColumnsAndTheTracesOfNoTime) {
  const RunTrace trace = test::made_up_run("S", "cur").trace;
  const RunTrace less = thinned(trace, 10);
  EXPECT_EQ(less.columns, trace.columns);
  EXPECT_EQ(less.rows.size(), 10u);
  EXPECT_EQ(less.rows.back(), trace.rows.back());
  EXPECT_TRUE(thinned({}, 10).rows.empty());
}

}  // namespace
}  // namespace kestrel

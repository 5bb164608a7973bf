#include "kestrel/io/svg_histogram.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Histogram, EachValueIsCountedOnceInTheBinItLiesIn) {
  test::Random random("histogram");
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(random.uniform(-3, 7));
  const auto bins = histogram_bins(values, 0.5);
  long all = 0;
  for (const HistogramBin& bin : bins) {
    all += bin.count;
    EXPECT_NEAR(std::remainder(bin.low, 0.5), 0, 1e-12);
    long inside = 0;
    for (const double value : values) inside += value >= bin.low && value < bin.low + 0.5 ? 1 : 0;
    EXPECT_EQ(bin.count, inside);
  }
  EXPECT_EQ(all, 1000);
}

TEST(Histogram, EmptyBinsBetweenAreThere) {
  const auto bins = histogram_bins({10, 12.5, kNan}, 1);
  ASSERT_EQ(bins.size(), 3u);
  EXPECT_EQ(bins[0].low, 10);
  EXPECT_EQ(bins[1].count, 0);
  EXPECT_EQ(bins[2].count, 1);
  EXPECT_TRUE(histogram_bins({kNan}, 1).empty());
}

TEST(Histogram, AWidthThatCannotBeIsAMistake) {
  EXPECT_THROW(histogram_bins({1}, 0), std::invalid_argument);
  EXPECT_THROW(histogram_bins({1}, kNan), std::invalid_argument);
  EXPECT_THROW(histogram_bins({0, 1e9}, 1), std::invalid_argument);
}

TEST(Histogram, APictureOfValuesNamesWhatLiesFarOutside) {
  std::vector<double> values(200, 0);
  std::iota(values.begin(), values.end(), 100);
  EXPECT_THAT(svg_histogram({"Latency", "ms", values}), Not(HasSubstr("outside")));
  values.push_back(1e7);
  EXPECT_THAT(svg_histogram({"Latency", "ms", values}), HasSubstr("1 of 201 lie outside"));
}

TEST(Histogram, NoValuesAndEqualValuesAreDrawnToo) {
  EXPECT_THAT(svg_histogram({"Latency", "ms", {}}), HasSubstr("no values to show"));
  EXPECT_THAT(svg_histogram({"Latency", "ms", {50, 50, 50}}), HasSubstr("<svg"));
  EXPECT_THAT(svg_histogram({"Latency", "ms", {0, 0}}), HasSubstr("<svg"));
}

}  // namespace
}  // namespace kestrel

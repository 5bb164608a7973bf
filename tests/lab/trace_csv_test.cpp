#include "kestrel/lab/trace_csv.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(TraceCsv, WritesNamesRowsAndNothingForNoValue) {
  const RunTrace trace{{"step", "time_s", "condition"}, {{0, 0, kNone}, {1, 0.1, kInfinite}}};
  EXPECT_EQ(trace_csv(trace), "step,time_s,condition\n0,0,\n1,0.1,inf\n");
}

TEST(TraceCsv, ReadsBackTheSameBits) {
  test::Random random("trace");
  RunTrace trace{{"a", "b", "c"}, {}};
  for (int i = 0; i < 500; ++i) {
    const double scale = std::pow(10., random.uniform(-200, 200));
    trace.rows.push_back({scale * random.uniform(-1, 1), double(i), i % 3 == 0 ? kNone : -scale});
  }
  const RunTrace back = trace_of_csv(trace_csv(trace));
  EXPECT_EQ(back.columns, trace.columns);
  ASSERT_EQ(back.rows.size(), trace.rows.size());
  for (std::size_t i = 0; i < back.rows.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double was = trace.rows[i][k];
      EXPECT_TRUE(back.rows[i][k] == was || (std::isnan(was) && std::isnan(back.rows[i][k])));
    }
  }
}

TEST(TraceCsv, RefusesWhatIsNotWhole) {
  const auto message = [](const std::string& text) {
    return test::message_of([&] { trace_of_csv(text); });
  };
  EXPECT_EQ(message(""), "trace: line 1: is missing");
  EXPECT_EQ(message("a,b\n1,2\n3"), "trace: line 3: is not whole");
  EXPECT_EQ(message("a,b\n1\n"), "trace: line 2: has not as many values as there are columns");
  EXPECT_EQ(message("a,b\n1,x\n"), "trace: line 2: 'x' is no number");
  EXPECT_THROW(trace_csv({{"a", "b"}, {{1}}}), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

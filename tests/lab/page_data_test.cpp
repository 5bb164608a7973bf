#include "kestrel/lab/page_data.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "kestrel/lab/trace_thinning.hpp"

#include "lab/made_up_report.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<double> decoded(const nlohmann::json& column) {
  std::vector<double> out;
  double sum = 0;
  for (std::size_t i = 1; i < column.size(); ++i) {
    if (!column[i].is_null()) sum += column[i].get<double>();
    out.push_back(column[i].is_null() ? std::nan("") : sum * column[0].get<double>());
  }
  return out;
}

TEST(PageData, GivesTheNumbersBack) {
  LabReport report = test::made_up_report();
  const auto json = nlohmann::json::parse(page_data(report, 1000));
  EXPECT_EQ(json["laws"], (std::vector<std::string>{"cur", "a<b & \"c\""}));
  EXPECT_EQ(json["runs"].size(), report.runs.size());
  const auto& run = json["runs"][0];
  EXPECT_EQ(run["end"], "converged");
  EXPECT_EQ(run["k"]["retreat_m"], 0.25);
  const auto channels = drawn_channels(report.runs[0].trace);
  const auto rows = kept_rows(report.runs[0].trace.column("time_s"), channels, 1000);
  ASSERT_EQ(run["t"].size(), rows.size());
  for (const TraceChannel& channel : channels) {
    const std::vector<double> values = decoded(run["c"][channel.column]);
    ASSERT_EQ(values.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      EXPECT_NEAR(values[i], channel.values[rows[i]], channel.resolution / 2 + 1e-9);
  }
}

TEST(PageData, CanStandInAScript) {
  LabReport report = test::made_up_report();
  report.runs[0].law = "</script><!--\xff";
  const std::string data = page_data(report, 10);
  EXPECT_THAT(data, Not(HasSubstr("<")));
  EXPECT_NO_THROW(nlohmann::json::parse(data));
}

TEST(PageData, ANumberThatIsNoneIsNull) {
  LabReport report = test::made_up_report();
  for (auto& row : report.runs[0].trace.rows) row[5] = std::nan("");
  report.runs[0].metrics = {{"retreat_m", std::numeric_limits<double>::infinity()}};
  report.scenes[0].start.origin_m.x() = std::nan("");
  const auto json = nlohmann::json::parse(page_data(report, 10));
  EXPECT_TRUE(json["runs"][0]["c"]["vx_m_s"][1].is_null());
  EXPECT_FALSE(json["runs"][0]["k"].contains("retreat_m"));
  EXPECT_TRUE(json["scenes"]["S2_rz45"]["start"]["at"][0].is_null());
}

TEST(PageData, RunsWithoutATraceHaveNone) {
  LabReport report = test::made_up_report();
  report.runs[0].trace = {};
  const auto json = nlohmann::json::parse(page_data(report, 10));
  EXPECT_FALSE(json["runs"][0].contains("t"));
  EXPECT_TRUE(json["runs"][1].contains("t"));
  EXPECT_EQ(nlohmann::json::parse(page_data({}, 10))["runs"].size(), 0u);
}

}  // namespace
}  // namespace kestrel

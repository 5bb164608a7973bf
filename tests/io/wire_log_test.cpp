#include "kestrel/io/wire_log.hpp"

#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

// A frame of 30 Hz, commands of 20 Hz: the third command rests on the frame of the second.
const std::vector<WireTime> kTimes = {
    {100.00, std::nullopt}, {100.05, 100.03}, {100.10, 100.03}, {100.16, 100.13}};

TEST(WireLog, ACommandThatIsSentAgainIsNoNews) {
  const WireStatistics s = wire_statistics(kTimes);
  EXPECT_THAT(s.period_ms,
              ElementsAre(DoubleNear(50, 1e-6), DoubleNear(50, 1e-6), DoubleNear(60, 1e-6)));
  EXPECT_THAT(s.latency_ms, ElementsAre(DoubleNear(20, 1e-6), DoubleNear(30, 1e-6)));
  EXPECT_TRUE(wire_statistics({}).period_ms.empty());
}

TEST(WireLog, TheTableCountsFromTheFirstCommand) {
  const test::TempFolder folder;
  WireLog log(folder / "wire.csv");
  for (const WireTime& time : kTimes) log.write(time);
  std::ifstream file(folder / "wire.csv");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(),
            "sent_s,capture_s,period_ms,age_ms,first\n"
            "0.000000,,,,0\n"
            "0.050000,0.030000,50.000,20.000,1\n"
            "0.100000,0.030000,50.000,70.000,0\n"
            "0.160000,0.130000,60.000,30.000,1\n");
  EXPECT_EQ(log.times().size(), 4u);
}

TEST(WireLog, TheReportHasBothHistogramsAndTheirTable) {
  const ReportSection section = wire_section(kTimes);
  ASSERT_EQ(section.figures.size(), 2u);
  EXPECT_THAT(section.figures[0], HasSubstr("Period of the commands"));
  EXPECT_THAT(section.figures[1], HasSubstr("Latency, capture to wire"));
  ASSERT_EQ(section.tables.size(), 1u);
  EXPECT_THAT(section.tables[0].rows[0],
              ElementsAre("period", "3", "50.00", "60.00", "60.00", "60.00"));
  EXPECT_THAT(section.tables[0].rows[1],
              ElementsAre("latency", "2", "30.00", "30.00", "30.00", "30.00"));
  EXPECT_EQ(wire_section({}).tables[0].rows[0][2], "n/a");
}

}  // namespace
}  // namespace kestrel

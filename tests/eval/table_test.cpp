#include "kestrel/eval/table.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

Table example() {
  return {{{"name"}, {"error_px", 2}, {"found"}, {"lost"}},
          {{std::string("a, \"b\""), 1.0 / 3, std::int64_t(12), true},
           {std::string("c"), std::numeric_limits<double>::infinity(), std::int64_t(5), false}}};
}

TEST(Table, CsvHasFullPrecisionAndQuotes) {
  EXPECT_EQ(csv(example()),
            "name,error_px,found,lost\n\"a, \"\"b\"\"\",0.3333333333333333,12,true\nc,,5,false\n");
}

TEST(Table, JsonHasAnObjectForEachRow) {
  EXPECT_EQ(json(example(), -1),
            R"([{"name":"a, \"b\"","error_px":0.3333333333333333,"found":12,"lost":true},)"
            R"({"name":"c","error_px":null,"found":5,"lost":false}])");
}

TEST(Table, AReaderGetsRoundNumbersAndUnits) {
  const ReportTable table = readable(example());
  EXPECT_EQ(table.head, (std::vector<std::string>{"name", "error (px)", "found", "lost"}));
  EXPECT_EQ(table.rows[0][1], "0.33");
  EXPECT_EQ(table.rows[1][1], "\u2013");
  EXPECT_EQ(table.rows[0][3], "yes");
}

TEST(Table, LinesAreAligned) {
  const ReportTable table{"", {"name", "px"}, {{"a", "1.5"}, {"longer", "10.5"}, {"c", "\u2013"}}};
  EXPECT_EQ(aligned(table), "name      px\na        1.5\nlonger  10.5\nc          \u2013\n");
}

TEST(Table, ARowOfAnotherLengthIsRefused) {
  Table table = example();
  table.rows[1].pop_back();
  EXPECT_THROW(csv(table), std::invalid_argument);
  EXPECT_THROW(json(table, 2), std::invalid_argument);
  EXPECT_THROW(readable(table), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

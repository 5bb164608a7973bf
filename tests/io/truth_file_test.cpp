#include "kestrel/io/truth_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

const std::string kHeader = "frame,x0,y0,x1,y1,x2,y2,x3,y3\n";

class TruthFile : public ::testing::Test {
 protected:
  Truth load(const std::string& text) { return load_truth(folder_.write("t.csv", text)); }
  std::string error_of(const std::string& text) {
    return test::message_of([&] { load(text); });
  }
  test::TempFolder folder_;
};

TEST_F(TruthFile, KeepsFramesAndTheOrderOfCorners) {
  const Truth truth = load(kHeader + "0,1,2,3.5,4,5,6,7,-8\r\n\n12, 1,1,1,1,1,1,1,1\n");
  ASSERT_EQ(truth.size(), 2u);
  const auto& corners = truth.at(0);
  const double expected[] = {1, 2, 3.5, 4, 5, 6, 7, -8};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(corners[i].u, expected[2 * i]);
    EXPECT_EQ(corners[i].v, expected[2 * i + 1]);
  }
  EXPECT_EQ(truth.count(12), 1u);
}

TEST_F(TruthFile, NamesTheLineOfAMistake) {
  EXPECT_THAT(error_of("x,y\n0,1\n"), HasSubstr("t.csv:1: the header is not frame,x0"));
  EXPECT_THAT(error_of(kHeader + "0,1,2,3,4,5,6,7\n"), HasSubstr("t.csv:2: has 8 columns; give 9"));
  EXPECT_THAT(error_of(kHeader + "0,1,2,3,4,5,6,7,8\n1,1,2,3,4,5,6,7,8,9\n"),
              HasSubstr("t.csv:3: has 10 columns"));
  EXPECT_THAT(error_of(kHeader + "0,1,2,3,4,5,6,7,x\n"), HasSubstr("t.csv:2: 'x' is not a number"));
  EXPECT_THAT(error_of(kHeader + "0,1,2,3,4,5,6,7,\n"), HasSubstr("t.csv:2: '' is not a number"));
  EXPECT_THAT(error_of(kHeader + "0,1,2,3,4,5,6,7,nan\n"), HasSubstr("not finite"));
  EXPECT_THAT(error_of(kHeader + "0.5,1,2,3,4,5,6,7,8\n"), HasSubstr("not a whole number"));
  EXPECT_THAT(error_of(kHeader + "4,1,2,3,4,5,6,7,8\n4,1,2,3,4,5,6,7,8\n"),
              HasSubstr("t.csv:3: frame 4 is given twice"));
}

TEST_F(TruthFile, RefusesAFileWithoutRows) {
  EXPECT_THAT(error_of(""), HasSubstr("has no row"));
  EXPECT_THAT(error_of(kHeader), HasSubstr("has no row"));
  EXPECT_THAT(test::message_of([&] { load_truth(folder_.path() / "none.csv"); }),
              HasSubstr("there is no such file"));
}

}  // namespace
}  // namespace kestrel

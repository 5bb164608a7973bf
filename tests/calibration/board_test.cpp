#include "kestrel/calibration/board.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using ::testing::HasSubstr;

TEST(ParseBoard, ReadsWhatToStringWrites) {
  for (const char* text : {"chessboard:9x6:0.025", "circles:7x5:0.03", "acircles:4x11:0.02",
                           "charuco:5x7:0.04:0.02:6X6_250"}) {
    EXPECT_EQ(to_string(parse_board(text)), text);
  }
  EXPECT_EQ(parse_board("charuco:5x7:0.04:0.02").dictionary, "4X4_50");
  EXPECT_EQ(parse_board("acircles:4x11:0.02").pattern, Pattern::AsymmetricCircles);
}

TEST(ParseBoard, SaysWhatIsWrongAndHowItIsWritten) {
  const auto error = [](const std::string& text) { return message_of([&] { parse_board(text); }); };
  EXPECT_THAT(error("chess:9x6:0.025"), HasSubstr("'chess' is no pattern"));
  EXPECT_THAT(error("chess:9x6:0.025"), HasSubstr("write chessboard:9x6:0.025"));
  EXPECT_THAT(error("chessboard:9x6"), HasSubstr("has 2 parts"));
  EXPECT_THAT(error("chessboard:9x6:0.025:1"), HasSubstr("has 4 parts"));
  EXPECT_THAT(error("chessboard:9:0.025"), HasSubstr("'9' is not COLUMNSxROWS"));
  EXPECT_THAT(error("chessboard:9x1:0.025"), HasSubstr("'1' is no count"));
  EXPECT_THAT(error("chessboard:9x6.5:0.025"), HasSubstr("'6.5' is no count"));
  EXPECT_THAT(error("chessboard:9x6:25mm"), HasSubstr("'25mm' is no size in m"));
  EXPECT_THAT(error("chessboard:9x6:nan"), HasSubstr("'nan' is no size"));
  EXPECT_THAT(error("chessboard:9x6:-1"), HasSubstr("'-1' is no size"));
  EXPECT_THAT(error("chessboard:2x6:1"), HasSubstr("at least 3 x 3"));
  EXPECT_THAT(error("charuco:5x7:0.02:0.04"), HasSubstr("smaller than the square"));
  EXPECT_THAT(error("charuco:5x7:0.04:0.02:9X9_9"), HasSubstr("dictionary"));
}

TEST(BoardPoints, StandRowByRow) {
  const auto points = board_points(parse_board("chessboard:9x6:0.025"));
  ASSERT_EQ(points.size(), 54u);
  EXPECT_TRUE(points[0].isZero());
  EXPECT_TRUE(points[1].isApprox(Eigen::Vector3d(0.025, 0, 0)));
  EXPECT_TRUE(points[9].isApprox(Eigen::Vector3d(0, 0.025, 0)));
  EXPECT_EQ(board_points(parse_board("charuco:5x7:0.04:0.02")).size(), 24u);  // inner corners
}

// OpenCV's acircles: every second row is shifted by half the distance in a row.
TEST(BoardPoints, OfAsymmetricCirclesAreShiftedInEverySecondRow) {
  const auto points = board_points(parse_board("acircles:4x11:0.02"));
  ASSERT_EQ(points.size(), 44u);
  EXPECT_TRUE(points[1].isApprox(Eigen::Vector3d(0.04, 0, 0)));
  EXPECT_TRUE(points[4].isApprox(Eigen::Vector3d(0.02, 0.02, 0)));
  EXPECT_TRUE(points[8].isApprox(Eigen::Vector3d(0, 0.04, 0)));
}

TEST(Board, NamesTheOptionOutOfRange) {
  const auto error = [](auto change) {
    Board board;
    change(board);
    return message_of([&] { board.check(); });
  };
  EXPECT_THAT(error([](Board& b) { b.columns = 1; }), HasSubstr("columns"));
  EXPECT_THAT(error([](Board& b) { b.rows = 101; }), HasSubstr("rows"));
  EXPECT_THAT(error([](Board& b) { b.spacing_m = 0; }), HasSubstr("spacing_m"));
  EXPECT_THAT(error([](Board& b) { b.pattern = Pattern::Charuco; }), HasSubstr("marker_m"));
}

}  // namespace
}  // namespace kestrel

#include "kestrel/calibration/visp_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using ::testing::HasSubstr;

/// In the form of ViSP's default-chessboard.cfg.
const char* const kChessboard =
    "# Number of inner corners per row and column\n"
    "BoardSize_Width: 9\nBoardSize_Height: 6\n\n"
    "# Size of a square in meters\nSquare_Size: 0.025\n\n"
    "# One of: CHESSBOARD or CIRCLES_GRID\nCalibrate_Pattern: CHESSBOARD\n\n"
    "Input: chessboard-%02d.jpg\n\nTempo: 1\n";

class VispConfigFile : public ::testing::Test {
 protected:
  VispConfig load(const std::string& text) {
    return load_visp_config(folder_.write("default.cfg", text));
  }
  std::string changed(const std::string& from, const std::string& to) const {
    std::string text = kChessboard;
    return text.replace(text.find(from), from.size(), to);
  }
  test::TempFolder folder_;
};

TEST_F(VispConfigFile, GivesBoardAndInput) {
  const VispConfig config = load(kChessboard);
  EXPECT_EQ(to_string(config.board), "chessboard:9x6:0.025");
  EXPECT_EQ(config.input, (folder_ / "chessboard-%02d.jpg").string());
}

TEST_F(VispConfigFile, KnowsCircles) {
  EXPECT_EQ(load(changed("Calibrate_Pattern: CHESSBOARD", "Calibrate_Pattern: CIRCLES_GRID"))
                .board.pattern,
            Pattern::Circles);
}

TEST_F(VispConfigFile, MayNameNoInput) {
  EXPECT_EQ(load(changed("Input: chessboard-%02d.jpg\n", "")).input, "");
}

TEST_F(VispConfigFile, NamesTheLineOfAMistake) {
  const auto error = [&](const std::string& from, const std::string& to) {
    return message_of([&] { load(changed(from, to)); });
  };
  EXPECT_THAT(error("Width: 9", "Width: nine"), HasSubstr("default.cfg:2: BoardSize_Width"));
  EXPECT_THAT(error("Height: 6", "Height: 1"), HasSubstr("default.cfg:3: BoardSize_Height: is no"));
  EXPECT_THAT(error("0.025", "0"), HasSubstr("default.cfg:6: Square_Size"));
  EXPECT_THAT(error("n: CHESSBOARD", "n: STRIPES"), HasSubstr("default.cfg:9: Calibrate_Pattern"));
  EXPECT_THAT(error("Square_Size: 0.025\n", ""), HasSubstr("Square_Size"));
  EXPECT_THAT(message_of([&] { load_visp_config(folder_ / "none.cfg"); }),
              HasSubstr("there is no such file"));
}

}  // namespace
}  // namespace kestrel

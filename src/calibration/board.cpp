#include "kestrel/calibration/board.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/io/csv.hpp"

#include "dictionary.hpp"

namespace kestrel {
namespace {

const char* const kForms =
    "write chessboard:9x6:0.025 (inner corners, side of a square in m), circles:7x5:0.03, "
    "acircles:4x11:0.02 or charuco:5x7:0.04:0.02:4X4_50 (squares, side of a square, of a marker)";

constexpr std::pair<Pattern, const char*> kWords[] = {{Pattern::Chessboard, "chessboard"},
                                                      {Pattern::Circles, "circles"},
                                                      {Pattern::AsymmetricCircles, "acircles"},
                                                      {Pattern::Charuco, "charuco"}};

[[noreturn]] void refuse(const std::string& text, const std::string& what) {
  throw std::invalid_argument("board '" + text + "': " + what + "; " + kForms);
}

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

double size_m(const std::string& text, const std::string& word) {
  const auto value = csv_number(word);
  if (!value || !(*value > 0) || !(*value < 100)) refuse(text, "'" + word + "' is no size in m");
  return *value;
}

int count(const std::string& text, const std::string& word) {
  const auto value = csv_number(word);
  if (!value || !(*value >= 2 && *value <= 100) || *value != std::floor(*value))
    refuse(text, "'" + word + "' is no count from 2 to 100");
  return int(*value);
}

void require(bool good, const char* what) {
  if (!good) throw std::invalid_argument(what);
}

}  // namespace

void Board::check() const {
  require(columns >= 2 && columns <= 100, "board: columns must be 2 to 100");
  require(rows >= 2 && rows <= 100, "board: rows must be 2 to 100");
  require(std::isfinite(spacing_m) && spacing_m > 0, "board: spacing_m must be positive");
  // OpenCV's finder turns any smaller chessboard down.
  require(pattern != Pattern::Chessboard || (columns > 2 && rows > 2),
          "board: a chessboard needs at least 3 x 3 inner corners");
  if (pattern != Pattern::Charuco) return;
  require(columns > 2 && rows > 2, "board: a ChArUco board needs at least 3 x 3 squares");
  require(marker_m > 0 && marker_m < spacing_m,
          "board: marker_m must be positive and smaller than the square");
  require(marker_dictionary(dictionary).has_value(),
          "board: dictionary is none of OpenCV's (4X4_50, 5X5_100, 6X6_250, ARUCO_ORIGINAL, ...)");
}

Board parse_board(const std::string& text) {
  const std::vector<std::string> parts = parts_of(text, ':');
  const auto* const word =
      std::find_if(std::begin(kWords), std::end(kWords),
                   [&](const auto& known) { return parts[0] == known.second; });
  if (word == std::end(kWords)) refuse(text, "'" + parts[0] + "' is no pattern");
  Board board;
  board.pattern = word->first;
  const bool charuco = board.pattern == Pattern::Charuco;
  if (parts.size() < (charuco ? 4U : 3U) || parts.size() > (charuco ? 5U : 3U))
    refuse(text, "has " + std::to_string(parts.size()) + " parts");
  const std::vector<std::string> counts = parts_of(parts[1], 'x');
  if (counts.size() != 2) refuse(text, "'" + parts[1] + "' is not COLUMNSxROWS");
  board.columns = count(text, counts[0]);
  board.rows = count(text, counts[1]);
  board.spacing_m = size_m(text, parts[2]);
  if (charuco) board.marker_m = size_m(text, parts[3]);
  if (parts.size() > 4) board.dictionary = parts[4];
  try {
    board.check();
  } catch (const std::invalid_argument& error) {
    refuse(text, error.what());
  }
  return board;
}

std::string to_string(const Board& board) {
  std::string text;
  for (const auto& [pattern, word] : kWords)
    if (pattern == board.pattern) text = word;
  text += fmt::format(":{}x{}:{}", board.columns, board.rows, number(board.spacing_m));
  if (board.pattern == Pattern::Charuco)
    text += fmt::format(":{}:{}", number(board.marker_m), board.dictionary);
  return text;
}

std::vector<Eigen::Vector3d> board_points(const Board& board) {
  const bool charuco = board.pattern == Pattern::Charuco;
  const int columns = board.columns - (charuco ? 1 : 0);
  const int rows = board.rows - (charuco ? 1 : 0);
  std::vector<Eigen::Vector3d> points;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int x = board.pattern == Pattern::AsymmetricCircles ? 2 * column + row % 2 : column;
      points.emplace_back(x * board.spacing_m, row * board.spacing_m, 0);
    }
  }
  return points;
}

}  // namespace kestrel

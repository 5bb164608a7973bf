#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// What is printed on a calibration board.
enum class Pattern {
  Chessboard,         // columns x rows inner corners
  Circles,            // columns x rows circles
  AsymmetricCircles,  // OpenCV's acircles: `rows` rows of `columns` circles, every second row
                      // shifted by spacing_m
  Charuco,            // columns x rows squares, a marker in each white one
};

/// A flat calibration board.
struct Board {
  Pattern pattern = Pattern::Chessboard;
  int columns = 9;
  int rows = 6;
  /// Side of a square, or distance of neighbouring circles, m; of asymmetric circles the distance
  /// of two rows, half of that of two circles in a row.
  double spacing_m = 0.025;
  double marker_m = 0;                // Charuco: side of a marker, m
  std::string dictionary = "4X4_50";  // Charuco: one of OpenCV's names without DICT_

  /// Throws std::invalid_argument that names the first option out of its range.
  void check() const;
};

/// The board that words of the command line name: "chessboard:9x6:0.025", "circles:7x5:0.03",
/// "acircles:4x11:0.02", "charuco:5x7:0.04:0.02:4X4_50" (columns x rows, sizes in m). Throws
/// std::invalid_argument that says what is wrong and how it is written.
Board parse_board(const std::string& text);

/// The words of a board, as parse_board takes them.
std::string to_string(const Board& board);

/// The points that are looked for on the board, z = 0, m, in a frame with its origin at the first
/// one, x along the columns and y along the rows; row by row.
std::vector<Eigen::Vector3d> board_points(const Board& board);

/// A point of the board that was found: its place in board_points and where it is seen.
struct BoardPoint {
  int id = 0;
  Pixel in_image;
};

/// What was found of the board in one picture.
struct BoardView {
  std::string name;  // of the picture
  std::vector<BoardPoint> points;
};

}  // namespace kestrel

#include "kestrel/io/truth_file.hpp"

#include <sstream>
#include <string>
#include <vector>

namespace kestrel {
namespace {

constexpr const char* kHeader = "frame,x0,y0,x1,y1,x2,y2,x3,y3";

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else if (c != ' ') {
      cells.back() += c;
    }
  }
  return cells;
}

std::array<Pixel, 4> corners_of(const std::vector<std::string>& cells) {
  std::array<Pixel, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i] = {parse_number(cells[2 * i + 1]), parse_number(cells[2 * i + 2])};
  }
  return corners;
}

}  // namespace

Truth load_truth(const std::filesystem::path& file) {
  std::istringstream lines(read_text(file));
  Truth truth;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (number == 1 && line != kHeader) {
      throw FileError(file, 1, "", std::string("the header is not ") + kHeader + "; add it");
    }
    if (number == 1 || line.empty()) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != 9) {
      throw FileError(file, number, "", "has " + std::to_string(cells.size()) + " columns; give 9");
    }
    try {
      const std::int64_t frame = parse_integer(cells[0]);
      if (!truth.emplace(frame, corners_of(cells)).second) {
        throw FileError(file, number, "", "frame " + cells[0] + " is given twice; remove one");
      }
    } catch (const std::invalid_argument& error) {
      throw FileError(file, number, "", error.what());
    }
  }
  if (truth.empty()) throw FileError(file, 0, "", "has no row of corners; add one per frame");
  return truth;
}

}  // namespace kestrel

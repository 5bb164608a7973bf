#include "kestrel/io/mount_sketch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace kestrel {
namespace {

constexpr int kRows = 7;
constexpr int kColumns = 23;
constexpr int kLong = 2;              // rows from the camera to the tip
constexpr double kColumnsPerRow = 2;  // of a terminal's characters
constexpr double kAcross = 0.35;      // less of the axis in the plane of the drawing: it is across

using Canvas = std::array<std::string, kRows>;

void put(Canvas& canvas, double right, double up, char mark) {
  const int row = kRows / 2 - int(std::lround(up));
  const int column = kColumns / 2 + int(std::lround(right * kColumnsPerRow));
  canvas[std::size_t(row)][std::size_t(column)] = mark;
}

void write(std::string& line, int column, const std::string& word) {
  line.replace(std::size_t(column), word.size(), word);
}

/// What is seen of the optical axis: to the right, up, and towards who looks.
struct Axis {
  double right;
  double up;
  double nearer;
};

/// The four directions of a drawing, clockwise from above.
using Directions = std::array<const char*, 4>;

Canvas drawn(const Axis& axis, const Directions& words) {
  Canvas canvas;
  canvas.fill(std::string(kColumns, ' '));
  const auto middle = [](const std::string& word) { return (kColumns - int(word.size())) / 2; };
  write(canvas.front(), middle(words[0]), words[0]);
  write(canvas[kRows / 2], kColumns - int(std::string(words[1]).size()), words[1]);
  write(canvas.back(), middle(words[2]), words[2]);
  write(canvas[kRows / 2], 0, words[3]);
  if (std::hypot(axis.right, axis.up) < kAcross) {
    put(canvas, 0, 0, axis.nearer > 0 ? '@' : 'x');
    return canvas;
  }
  put(canvas, 0, 0, 'o');
  const double longer = std::max(std::abs(axis.right), std::abs(axis.up));
  for (int k = 1; k <= kLong; ++k)
    put(canvas, k * axis.right / longer, k * axis.up / longer, k == kLong ? '*' : '.');
  return canvas;
}

}  // namespace

std::vector<std::string> mount_sketch(const Mount& body_from_camera) {
  const Eigen::Vector3d looks = body_from_camera.rotation.col(2);  // forward, right, down
  const Canvas above = drawn({looks.y(), looks.x(), -looks.z()}, {"nose", "right", "tail", "left"});
  const Canvas side = drawn({looks.x(), -looks.z(), looks.y()}, {"up", "nose", "down", "tail"});
  std::vector<std::string> lines{"from above                 from the right"};
  for (std::size_t i = 0; i < kRows; ++i) {
    std::string line = above[i] + "    " + side[i];
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(line);
  }
  return lines;
}

}  // namespace kestrel

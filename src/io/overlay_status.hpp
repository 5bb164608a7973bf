#pragma once

#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/vehicle/failsafe.hpp"

/// The status line below an overlay.
namespace kestrel {

/// Lines of text that fit a width, and how large they are drawn.
struct StatusText {
  std::vector<std::string> lines;
  double scale = 0.45;
  int rows = 1;  // lines there is room for

  int line_height() const { return int(36 * scale) + 2; }
  int height() const { return rows * line_height() + 6; }
};

/// The words (groups parted by three spaces) on as few lines as keep `longest` readable: all frames
/// of a run get the same height, whatever their words are.
StatusText fitted(const std::string& words, const std::string& longest, int width);

/// The longest words of a status line, with a command if one is given.
std::string longest_status(const std::optional<FailsafeCommand>& sent);

/// Draws the lines into the strip, light on dark; what is not servoing stands out.
void draw(const StatusText& status, cv::Mat strip);

}  // namespace kestrel

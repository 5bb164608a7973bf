#pragma once

#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

/// The status line below an overlay.
namespace kestrel {

/// Lines of text that fit a width, and how large they are drawn.
struct StatusText {
  std::vector<std::string> lines;
  double scale = 0.45;

  int line_height() const { return int(36 * scale) + 2; }
  int height() const { return int(lines.size()) * line_height() + 6; }
};

/// The words (groups parted by three spaces) on as few lines as keep them readable.
StatusText fitted(const std::string& words, int width);

/// Draws the lines into the strip, light on dark; what is not servoing stands out.
void draw(const StatusText& status, cv::Mat strip);

}  // namespace kestrel

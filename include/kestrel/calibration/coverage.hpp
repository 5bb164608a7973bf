#pragma once

#include <vector>

#include "kestrel/calibration/board.hpp"
#include "kestrel/io/camera_file.hpp"

namespace kestrel {

/// How the points of all views lie in the image: counts in cells, row by row from the upper left.
struct Coverage {
  int columns = 0;
  int rows = 0;
  std::vector<int> counts;
  double share = 0;  // of the cells that have a point
};

/// The coverage of an image by the views, in cells of about an eighth of its longer side. Points
/// outside the image do not count. Throws std::invalid_argument for an image without size.
Coverage coverage(const std::vector<BoardView>& views, ImageSize size);

}  // namespace kestrel

#include "kestrel/calibration/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace kestrel {

Coverage coverage(const std::vector<BoardView>& views, ImageSize size) {
  if (size.width <= 0 || size.height <= 0)
    throw std::invalid_argument("coverage: the image has no size");
  const double cell_px = std::max(size.width, size.height) / 8.0;
  Coverage out;
  out.columns = std::max(1, int(std::lround(size.width / cell_px)));
  out.rows = std::max(1, int(std::lround(size.height / cell_px)));
  out.counts.assign(std::size_t(out.columns) * std::size_t(out.rows), 0);
  for (const BoardView& view : views) {
    for (const BoardPoint& point : view.points) {
      const double column = std::floor((point.in_image.u + 0.5) / size.width * out.columns);
      const double row = std::floor((point.in_image.v + 0.5) / size.height * out.rows);
      if (!(column >= 0 && column < out.columns && row >= 0 && row < out.rows)) continue;
      ++out.counts[std::size_t(row) * std::size_t(out.columns) + std::size_t(column)];
    }
  }
  const auto empty = std::count(out.counts.begin(), out.counts.end(), 0);
  out.share = 1 - double(empty) / double(out.counts.size());
  return out;
}

}  // namespace kestrel

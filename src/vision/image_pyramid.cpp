#include "kestrel/vision/image_pyramid.hpp"

#include <algorithm>
#include <stdexcept>

#include "align/block_kernels.hpp"

namespace kestrel {
namespace {

struct Range {
  int begin = 0;
  int end = 0;
};

/// Pixels begin ... begin + length - 1, widened to multiples of a step, inside 0 ... limit.
Range widened(double begin, double length, int step, int limit) {
  const int first = int(begin) / step * step;
  const int last = int(begin + length);
  return {first, std::min((last + step - 1) / step * step, limit)};
}

/// The level's region from the one below.
void halve(const PyramidLevel& below, PyramidLevel& level, std::uint8_t* memory, Simd simd) {
  const kernel::HalveRow row = use_avx2(simd) ? kernel::halve_row_avx2 : kernel::halve_row_baseline;
  for (int y = level.top; y < level.bottom; ++y) {
    const std::uint8_t* upper =
        below.pixels + std::ptrdiff_t(y) * 2 * below.stride + std::ptrdiff_t(level.left) * 2;
    row(upper, upper + below.stride, level.right - level.left,
        memory + y * level.stride + level.left);
  }
}

}  // namespace

Eigen::Matrix3d level0_from_level(int level) {
  const double side = double(1 << level);
  Eigen::Matrix3d S = Eigen::Matrix3d::Identity();
  S(0, 0) = S(1, 1) = side;
  S(0, 2) = S(1, 2) = (side - 1) / 2;
  return S;
}

void ImagePyramid::look(const cv::Mat& gray, const PixelBox& window, int levels, Simd simd) {
  if (gray.empty() || gray.type() != CV_8UC1) {
    throw std::invalid_argument("image: must be 8-bit grey");
  }
  levels_ = std::clamp(levels, 1, kMaxLevels);
  const PixelBox box = clipped(window, gray.cols, gray.rows);
  const int step = 1 << (levels_ - 1);
  const Range u = widened(box.u, box.width, step, gray.cols);
  const Range v = widened(box.v, box.height, step, gray.rows);
  at_[0] = {gray.data, std::ptrdiff_t(gray.step[0]), u.begin, v.begin, u.end, v.end};
  for (int k = 1; k < levels_; ++k) {
    const PyramidLevel& below = at_[std::size_t(k - 1)];
    const int width = gray.cols >> k;
    const int height = gray.rows >> k;
    std::vector<std::uint8_t>& memory = memory_[std::size_t(k)];
    memory.resize(std::size_t(width) * std::size_t(height));
    PyramidLevel& level = at_[std::size_t(k)];
    level = {memory.data(),
             width,
             below.left / 2,
             below.top / 2,
             std::min(below.right / 2, width),
             std::min(below.bottom / 2, height)};
    halve(below, level, memory.data(), simd);
  }
}

}  // namespace kestrel

#include "places.hpp"

#include <algorithm>

namespace kestrel {
namespace {

/// The pyramid reaches this far beyond the outline, as a share of its size and at least so many px:
/// room for the alignment to move.
constexpr double kMarginShare = 0.15;
constexpr double kMarginPx = 16;

/// Places less than this apart, as a share of the outline's size, are one place.
constexpr double kSamePlaceShare = 0.05;

}  // namespace

PixelBox whole(const Frame& frame) {
  return {0, 0, double(frame.gray.cols), double(frame.gray.rows)};
}

PixelBox box_of(const Homography& image_from_template, const Template& model) {
  const auto c = outline(image_from_template, model.width(), model.height());
  const auto [left, right] = std::minmax({c[0].u, c[1].u, c[2].u, c[3].u});
  const auto [top, bottom] = std::minmax({c[0].v, c[1].v, c[2].v, c[3].v});
  return {left, top, right - left, bottom - top};
}

PixelBox with_margin(const PixelBox& box) {
  const double by = kMarginPx + kMarginShare * std::max(box.width, box.height);
  return {box.u - by, box.v - by, box.width + 2 * by, box.height + 2 * by};
}

PixelBox united(const PixelBox& a, const PixelBox& b) {
  const double left = std::min(a.u, b.u);
  const double top = std::min(a.v, b.v);
  return {left, top, std::max(a.u + a.width, b.u + b.width) - left,
          std::max(a.v + a.height, b.v + b.height) - top};
}

double apart(const Homography& a, const Homography& b, const Template& model) {
  const auto at = outline(a, model.width(), model.height());
  const auto to = outline(b, model.width(), model.height());
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += distance(at[i], to[i]);
  return sum / 4;
}

bool is_same(const Homography& a, const Homography& b, const Template& model) {
  const PixelBox box = box_of(a, model);
  return apart(a, b, model) <= kSamePlaceShare * std::max(box.width, box.height);
}

bool is_better(const Alignment& a, const Alignment& b) {
  return a.is_accepted != b.is_accepted ? a.is_accepted : a.agreement.shown() > b.agreement.shown();
}

}  // namespace kestrel

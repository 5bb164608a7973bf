#pragma once

#include "kestrel/geometry/homography.hpp"
#include "kestrel/geometry/pixel.hpp"
#include "kestrel/vision/align.hpp"
#include "kestrel/vision/frame.hpp"
#include "kestrel/vision/template.hpp"

namespace kestrel {

/// What a search in a frame is about: where the template may be. All in px of the image.

PixelBox whole(const Frame& frame);

/// The upright rectangle about the template's outline.
PixelBox box_of(const Homography& image_from_template, const Template& model);

/// The rectangle, and the room an alignment from there has to move in.
PixelBox with_margin(const PixelBox& box);

PixelBox united(const PixelBox& a, const PixelBox& b);

/// Mean distance of the template's corners at two places.
double apart(const Homography& a, const Homography& b, const Template& model);

/// True for two places too near each other to be two.
bool is_same(const Homography& a, const Homography& b, const Template& model);

/// True when a is accepted and b is not, or shows less of the template.
bool is_better(const Alignment& a, const Alignment& b);

}  // namespace kestrel

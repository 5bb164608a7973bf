#pragma once

#include <array>

#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// The first window: the template's rectangle, twice its width and height, same centre, inside the
/// image.
PixelBox first_window(const PixelBox& template_box, int image_width, int image_height);

/// The window around a found object: centred on the outline's bounding box, twice its width and
/// height, inside the image.
PixelBox window_around(const std::array<Pixel, 4>& outline, int image_width, int image_height);

/// The window after a miss: twice the area about the same centre, proportions kept until a side
/// reaches the image's, inside the image; in the end the whole image.
PixelBox doubled_window(const PixelBox& window, int image_width, int image_height);

}  // namespace kestrel

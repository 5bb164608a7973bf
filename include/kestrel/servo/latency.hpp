#pragma once

#include <vector>

#include "kestrel/geometry/transform.hpp"
#include "kestrel/servo/feature.hpp"

namespace kestrel {

/// How a camera moved: coordinates in it as it was then to coordinates in it as it is now.
using CameraMotion = Transform<frame::Camera, frame::Camera>;

/// The features with one depth for all, Z = Z* sqrt(a*/a) (m): Z* the mean depth of the desired
/// ones, a and a* the areas of the two polygons on the normalised plane. Exact for a target
/// parallel to the image. Empty when fewer than three points, not as many as desired, or an area is
/// zero or not finite.
std::vector<Feature> with_area_depth(const std::vector<Feature>& measured,
                                     const std::vector<Feature>& desired);

/// The features as the camera sees them after this motion, depths included, of a target that stands
/// still: what a law should be given when the image is old and the vehicle knows how it moved since
/// (dead reckoning).
std::vector<Feature> predicted(const std::vector<Feature>& features,
                               const CameraMotion& now_from_then);

}  // namespace kestrel

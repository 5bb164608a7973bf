#pragma once

#include <optional>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/geometry/homography.hpp"

namespace kestrel {

/// A view of a plane as the camera without its lens would have had it.
struct StraightView {
  Homography image_from_template;
  Camera camera;  // the same K, no distortion
};

/// The view of a template of this size (px) that was tracked through a lens. Through a lens a
/// plane's view is no homography: the tracked one is the nearest to it over the template, off by up
/// to some pixels, most at the corners. So points all over the template are taken by it into the
/// image, as far as they lie in it, their lens is removed, and a homography is fitted to those:
/// what the first fit leaves over is not in its span, and cancels to first order, where the tracker
/// weighed the template's parts alike. One that aligns through the lens needs no such fit
/// (Track::straight_from_template). Without a lens:
/// what was given, to the bit. Empty when fewer than a quarter of the points can be seen, or no
/// homography fits them.
std::optional<StraightView> straight_view(const Homography& image_from_template, double width_px,
                                          double height_px, const Camera& camera);

/// The other way: the homography nearest to what the camera with its lens sees of a template, at
/// points all over it, where the camera without has straight_from_template. Without a lens: what
/// was given, to the bit. Empty when fewer than a quarter of the points can be seen, or no
/// homography fits them.
std::optional<Homography> bent_view(const Homography& straight_from_template, double width_px,
                                    double height_px, const Camera& camera);

/// The camera without its lens: the same K, no distortion.
Camera without_lens(const Camera& camera);

}  // namespace kestrel

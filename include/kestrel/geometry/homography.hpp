#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// Plane projective map between two images, eq. (1)-(2) of the paper; H is scaled to H(2,2) = 1
/// where it comes from a fit. Named like transforms: image_from_template.
struct Homography {
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
};

/// The image of a point, px, eq. (3)-(4) of the paper; not finite for a point at infinity.
Pixel operator*(const Homography& image_from_template, const Pixel& in_template);

/// Corners of a template of this size (px): the centres of its corner pixels, in the order top
/// left, top right, bottom right, bottom left.
std::array<Pixel, 4> template_corners(double width_px, double height_px);

/// The template's corners in the image, same order.
std::array<Pixel, 4> outline(const Homography& image_from_template, double width_px,
                             double height_px);

/// Homography of at least four pairs: the eight parameters of eq. (4)-(5) of the paper, on
/// normalised points (Hartley 1997). Four pairs are met exactly, more in the least squares of
/// eq. (5), by SVD. Empty for fewer pairs, non-finite points, points in a degenerate position in
/// either image (three of four on a line, all on a line but one, all at one place), or when the
/// template's pixel (0, 0) goes to infinity.
std::optional<Homography> fit_homography(const std::vector<PixelPair>& pairs);

/// The homography that takes the corners of a template of this size to these four points, same
/// order as template_corners(), in closed form (Heckbert 1989, section 2.2.3); allocates nothing.
/// Empty when three of the points are on a line, one is not finite, or the template's pixel (0, 0)
/// goes to infinity.
std::optional<Homography> homography_from_outline(const std::array<Pixel, 4>& corners,
                                                  double width_px, double height_px);

/// What makes an outline a possible view of the template.
struct OutlineOptions {
  double min_area_ratio = 1.0 / 64;  // outline's area over the template's
  double max_area_ratio = 64;
  double min_side_px = 6;  // shortest side of the outline
};

/// True when the image of the template is finite, in front of the camera at every corner, convex,
/// of the template's orientation (not mirrored) and of plausible area.
bool is_plausible(const Homography& image_from_template, double width_px, double height_px,
                  const OutlineOptions& options = {});

/// Signed area of a polygon, px^2, positive when its corners turn clockwise on the screen.
double signed_area(const std::array<Pixel, 4>& corners);

}  // namespace kestrel

#pragma once

#include <optional>

#include "kernels.hpp"
#include "seen_plane.hpp"

namespace kestrel::sim_detail {

/// How the plane's texture is averaged over footprints like this one, which is finite. Where a
/// pixel spans two texels or less on its narrow side the texture itself is read, each tap the exact
/// mean over a rectangle of the footprint's spread along the rows and columns of the texture;
/// elsewhere the level of means that spans the narrow side in one tap. Taps stand side by side
/// along a side that is longer, and where the footprint lies askew to the texture's rows.
Reading reading(const SeenPlane& plane, const Footprint& footprint);

/// The same where each place is spread besides by this covariance, texels^2. Empty where that is
/// more than taps of the texture itself stand for.
std::optional<Reading> spread_reading(const SeenPlane& plane, const Footprint& footprint,
                                      const Eigen::Matrix2f& covariance);

}  // namespace kestrel::sim_detail

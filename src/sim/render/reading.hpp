#pragma once

#include "kernels.hpp"
#include "seen_plane.hpp"

namespace kestrel::sim_detail {

/// How the plane's texture is averaged over footprints like this one, which is finite. Where a
/// pixel spans two texels or less on its narrow side the texture itself is read, each tap the exact
/// mean over a rectangle of the footprint's spread along the rows and columns of the texture;
/// elsewhere the level of means that spans the narrow side in one tap. Taps stand side by side
/// along a side that is longer, and where the footprint lies askew to the texture's rows.
Reading reading(const SeenPlane& plane, const Footprint& footprint);

}  // namespace kestrel::sim_detail

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/io/text_file.hpp"

namespace kestrel {

/// Where the target's corners truly were, px, by frame index: top left, top right, bottom right,
/// bottom left of the target in the first labelled frame. A frame without a row is not labelled.
using Truth = std::map<std::int64_t, std::array<Pixel, 4>>;

/// Reads a CSV file with the header `frame,x0,y0,x1,y1,x2,y2,x3,y3` (0,0 is the centre of the first
/// pixel). Throws FileError with the line: another header, a row without nine finite numbers, a
/// frame given twice, no row at all.
Truth load_truth(const std::filesystem::path& file);

}  // namespace kestrel

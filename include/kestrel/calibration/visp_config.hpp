#pragma once

#include <filesystem>
#include <string>

#include "kestrel/calibration/board.hpp"

namespace kestrel {

/// What a configuration file of ViSP's calibration program asks for.
struct VispConfig {
  Board board;
  std::string input;  // pictures as a printf pattern, beside the file when relative; or empty
};

/// Reads ViSP's format (default-chessboard.cfg, default-circles.cfg): BoardSize_Width,
/// BoardSize_Height, Square_Size (m), Calibrate_Pattern (CHESSBOARD or CIRCLES_GRID) and Input;
/// keys that ViSP's program does not read either are passed over. Throws FileError with the line
/// for a key that is missing or wrong.
VispConfig load_visp_config(const std::filesystem::path& file);

}  // namespace kestrel

#include "kestrel/calibration/visp_config.hpp"

#include <stdexcept>

#include "kestrel/io/yaml_section.hpp"

namespace kestrel {

// Lines `key: value` and comments behind #: what ViSP reads word by word is YAML, too.
VispConfig load_visp_config(const std::filesystem::path& file) {
  const Section root = Section::load(file);
  VispConfig config;
  config.board.pattern = root.choice<Pattern>(
      "Calibrate_Pattern",
      {{"CHESSBOARD", Pattern::Chessboard}, {"CIRCLES_GRID", Pattern::Circles}});
  const auto count = [&](const char* key) {
    const std::int64_t value = root.integer(key);
    if (value < 2 || value > 100) root.fail(key, "is no count from 2 to 100");
    return int(value);
  };
  config.board.columns = count("BoardSize_Width");
  config.board.rows = count("BoardSize_Height");
  config.board.spacing_m = root.number("Square_Size");
  if (root.has("Input")) config.input = root.path("Input").string();
  try {
    config.board.check();
  } catch (const std::invalid_argument& error) {
    root.fail(config.board.spacing_m > 0 ? "BoardSize_Width" : "Square_Size", error.what());
  }
  return config;
}

}  // namespace kestrel

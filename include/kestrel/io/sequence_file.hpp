#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/io/sequence.hpp"
#include "kestrel/io/yaml_section.hpp"

namespace kestrel {

/// A recorded sequence as sequences/*.yaml describes it; sequences/README.md documents every key.
struct SequenceDescription {
  std::filesystem::path file;
  SequenceOptions sequence;  // its input with the path made relative to the working directory
  PixelBox template_px;      // the rectangle to select in the first frame
  std::optional<std::filesystem::path> camera;
  std::string camera_name;
  std::optional<std::filesystem::path> truth;
  std::optional<std::array<double, 2>> target_m;  // width and height of the rectangle
  std::string what;                               // what moves in front of what
  std::string origin;
  std::string licence;
};

/// Reads a description. Throws FileError with the line for every mistake.
SequenceDescription load_sequence(const std::filesystem::path& file);

/// A rectangle `[x, y, width, height]` of whole pixels under this key.
PixelBox read_pixel_box(const Section& section, const std::string& key);

}  // namespace kestrel

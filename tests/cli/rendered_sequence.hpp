#pragma once

#include <filesystem>
#include <string>

namespace kestrel::test {

/// A sequence on disk whose motion is known exactly.
struct RenderedSequence {
  std::string roi;  // "x,y,w,h" of the template in the first frame
};

/// Writes frames 0000.png ... of 320x240 px and truth.csv into a folder: a poster that drifts,
/// grows and turns by a known homography in front of grey.
RenderedSequence rendered_sequence(const std::filesystem::path& folder, int frames);

}  // namespace kestrel::test

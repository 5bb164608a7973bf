#pragma once

#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace kestrel::test {

/// Dev pictures may be used to choose settings, held-out ones to prove them only.
enum class StressSet { Dev, HeldOut };

/// A picture that becomes a poster, and one of another kind for the wall behind it.
struct StressTexture {
  std::string name;
  StressSet set = StressSet::Dev;
  std::string file;       // of the poster, where Debian installs it
  std::string wall_file;  // no other texture shows it
};

/// All pictures, dev first.
std::vector<StressTexture> stress_textures();

/// Names of one set.
std::vector<std::string> texture_names(StressSet set);

/// The texture of this name; throws std::invalid_argument for a name that is not in the list.
StressTexture stress_texture(const std::string& name);

/// 8-bit grey picture of a file; throws std::runtime_error that names the Debian packages that
/// install the pictures when it cannot be read.
cv::Mat load_picture(const std::string& file);

}  // namespace kestrel::test

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "kestrel/geometry/camera.hpp"
#include "kestrel/io/text_file.hpp"

namespace kestrel {

/// An image's size, px.
struct ImageSize {
  int width = 0;
  int height = 0;
};

/// The calibrated camera in a file: ViSP's XML (vpXmlParserCamera's format, the model with
/// distortion where there is one, or the plumb-bob lens that camera_writer puts beside it),
/// OpenCV's YAML or XML (camera_matrix, distortion_coefficients of 4 or 5 numbers; with
/// fisheye_model: 1 the 4 of Kannala-Brandt), or ROS's camera_info YAML (plumb_bob, equidistant).
/// name and size choose among several cameras of a ViSP file; an empty name takes the only one.
/// Throws FileError with the line for every mistake: no such camera, several that fit, a missing or
/// wrong number, a lens model that is not known.
///
/// ViSP's own reader is not called: it prints on standard output, gives no line, and takes
/// `<px>59x</px>` for 59 and a missing file for a default camera. The tests hold this reader to its
/// answers.
Camera load_camera(const std::filesystem::path& file, const std::string& name = "Camera",
                   const std::optional<ImageSize>& size = std::nullopt);

/// Throws FileError when the camera was calibrated for images of another size; a file that states
/// no size is taken at its word.
void require_resolution(const Camera& camera, int width, int height,
                        const std::filesystem::path& file);

}  // namespace kestrel

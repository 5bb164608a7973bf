#pragma once

#include <filesystem>
#include <string>

#include "kestrel/geometry/camera.hpp"

namespace kestrel {

/// The texts of files that load_camera reads back to the same projections (Camera::to_pixel), bit
/// for bit: numbers are written in full.

/// ViSP's camera XML. A plumb-bob lens, which ViSP has no model for, stands in
/// <additional_information> (which ViSP passes over), and the nearest camera of ViSP's own
/// (nearest_visp_camera) in its <model>. Throws std::invalid_argument as nearest_visp_camera.
std::string visp_xml(const Camera& camera, const std::string& name);

/// OpenCV's YAML as its calibration samples write it; a Kannala-Brandt lens with `fisheye_model: 1`
/// as the tutorial's program. ViSP's radial lens is written as k1 = kud; its kdu, an approximate
/// inverse, has no place there.
std::string opencv_yaml(const Camera& camera);

/// ROS's camera_info YAML: plumb_bob, or equidistant for a Kannala-Brandt lens; ViSP's radial lens
/// as in opencv_yaml. The rectification is the identity, the projection [K | 0].
std::string ros_yaml(const Camera& camera, const std::string& name);

/// Writes camera.xml, camera_opencv.yaml and camera_ros.yaml into a folder that is there. Throws
/// std::runtime_error with path, cause and remedy, std::invalid_argument as visp_xml.
void write_camera_files(const std::filesystem::path& folder, const Camera& camera,
                        const std::string& name);

}  // namespace kestrel

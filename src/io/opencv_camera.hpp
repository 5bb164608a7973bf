#pragma once

#include <filesystem>
#include <optional>

#include "kestrel/io/camera_file.hpp"

#include "xml_file.hpp"

/// The cameras that OpenCV and ROS write.
namespace kestrel {

/// Camera's constructor with its complaint turned into one about the file.
Camera camera_of(const CameraParameters& parameters, const std::filesystem::path& file, int line);

/// OpenCV's or ROS's YAML; `size` stands in where the file states none.
Camera load_camera_yaml(const std::filesystem::path& file, const std::optional<ImageSize>& size);

/// OpenCV's XML.
Camera load_opencv_xml(const Xml& xml, const std::filesystem::path& file);

}  // namespace kestrel

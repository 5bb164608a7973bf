#pragma once

#include <optional>
#include <string>

namespace kestrel {

/// OpenCV's number (cv::aruco::PREDEFINED_DICTIONARY_NAME) of a dictionary of markers, by its name
/// without DICT_; empty for one that is not known.
std::optional<int> marker_dictionary(const std::string& name);

}  // namespace kestrel

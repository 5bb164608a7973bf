#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace kestrel {

/// Files by number.
using NumberedFiles = std::map<std::int64_t, std::filesystem::path>;

/// True for a name that ends like an image that OpenCV reads: pgm, png, jpg, ...
bool is_image_name(const std::filesystem::path& file);

/// The files that a printf pattern with one %d or %0Nd in its last part names, by their number;
/// empty when there is none. Throws std::runtime_error for any other pattern.
NumberedFiles files_of_pattern(const std::string& pattern);

/// The images of a folder in natural order (2 before 10), numbered from 0; an image file counts as
/// a folder that holds it alone.
NumberedFiles files_of_folder(const std::filesystem::path& folder);

}  // namespace kestrel

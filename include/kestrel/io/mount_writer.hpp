#pragma once

#include <string>
#include <vector>

#include "kestrel/geometry/transform.hpp"

namespace kestrel {

/// The text of a mount file that load_mount reads back to the last bit: `translation_m` and
/// `rotation`, below these lines of comment and the words of describe().
std::string mount_yaml(const Mount& body_from_camera, const std::vector<std::string>& comment);

}  // namespace kestrel

#pragma once

#include <string>
#include <vector>

#include "kestrel/io/yaml_section.hpp"

namespace kestrel {

/// Refuses keys of a pose that could be read in more than one way. Throws FileError.
void refuse_ambiguous(const Section& section);

/// The key of these that is there, empty for none. Throws FileError for two.
std::string only_one_of(const Section& section, const std::vector<const char*>& keys);

}  // namespace kestrel

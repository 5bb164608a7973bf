#pragma once

#include "kestrel/io/yaml_section.hpp"
#include "kestrel/link/autopilot_adapter.hpp"

namespace kestrel::app {

/// The section `autopilot` of a task file; what is not given, and all without the section, is as
/// AutopilotOptions has it. Throws FileError.
AutopilotOptions read_autopilot(const Section& root);

}  // namespace kestrel::app

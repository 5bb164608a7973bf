#pragma once

#include "arguments.hpp"

namespace CLI {
class App;
}

namespace kestrel::app {

/// The options of the ground station on a verb; what: what --ground does there, in a sentence.
/// Wrong together (an address beyond this machine without TLS) is wrong usage.
void add_ground_options(CLI::App& verb, GroundArguments& ground, const std::string& what);

/// Those of the operator's own link to a switch, on a verb that flies; after add_ground_options.
void add_ground_link(CLI::App& verb, GroundArguments& ground);

}  // namespace kestrel::app

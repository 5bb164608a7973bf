#pragma once

#include "arguments.hpp"

namespace CLI {
class App;
}

namespace kestrel::app {

/// The options of the ground station on a verb; what: what --ground does there, in a sentence.
/// Wrong together (an address beyond this machine without TLS) is wrong usage.
void add_ground_options(CLI::App& verb, GroundArguments& ground, const std::string& what);

}  // namespace kestrel::app

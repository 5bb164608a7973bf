#pragma once

#include <functional>
#include <string>

#include "kestrel/io/live_source.hpp"

namespace kestrel {

/// Takes pictures of files down the chain, and prints how long each was in coming and in the chain.
void measure_file(const std::string& name, const std::string& input);

/// Takes the pictures of a camera down the chain, and prints how old they are; age(frame, now) is
/// the true one, ms.
void measure(const std::string& name, LiveSource& source,
             const std::function<double(const Frame&, double)>& age);

}  // namespace kestrel

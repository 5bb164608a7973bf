#pragma once

#include <string>

#include "kestrel/eval/bench.hpp"
#include "kestrel/vision/tracker.hpp"

namespace kestrel {

/// Kestrel's own tracker with these options, under this name. Throws std::invalid_argument for
/// options that their check() refuses.
BenchMethod track_method(const std::string& name, const TrackOptions& options);

}  // namespace kestrel

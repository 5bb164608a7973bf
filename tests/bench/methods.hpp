#pragma once

#include <vector>

#include "kestrel/eval/bench.hpp"

namespace kestrel::test {

/// kestrel's reference tracker, `paper` (vision/track.hpp).
BenchMethod paper_method();

/// All that stress_table compares: kestrel's own trackers first, then its peers. A new one is one
/// line in methods.cpp.
std::vector<BenchMethod> bench_methods();

}  // namespace kestrel::test

#pragma once

#include <string>
#include <vector>

#include "kestrel/eval/bench.hpp"

namespace kestrel::test {

/// All that stress_table compares: kestrel's own trackers first, then its peers. A new one is one
/// line in methods.cpp.
std::vector<BenchMethod> bench_methods();

/// Those of these names; all for no names. Throws std::invalid_argument when one is missing.
std::vector<BenchMethod> bench_methods(const std::vector<std::string>& names);

}  // namespace kestrel::test

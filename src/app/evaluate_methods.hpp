#pragma once

#include <string>
#include <vector>

#include "kestrel/eval/bench.hpp"

namespace kestrel::app {

/// The names of Kestrel's own methods.
std::vector<std::string> own_methods();

/// Why "KEY=VALUE,VALUE,..." is no setting of the tracker: an unknown key, a value out of range;
/// empty when it is one. Keys are those of a task file's section `track`.
std::string setting_fault(const std::string& setting);

/// One of Kestrel's methods under every combination of the settings, the last one's values changing
/// fastest; each is named "METHOD KEY=VALUE ...". Throws std::invalid_argument for a key that is
/// given twice and for what setting_fault refuses.
std::vector<BenchMethod> swept_methods(const std::string& method,
                                       const std::vector<std::string>& settings);

}  // namespace kestrel::app

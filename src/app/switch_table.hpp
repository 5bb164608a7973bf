#pragma once

#include <string>

namespace kestrel::app {

/// The status of a switch (JSON, as status_json writes it) in words for humans. Throws
/// std::runtime_error for what is no such status.
std::string switch_table(const std::string& json);

}  // namespace kestrel::app

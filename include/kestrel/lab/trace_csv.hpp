#pragma once

#include <string>

#include "kestrel/lab/lab_run.hpp"

namespace kestrel {

/// A trace as CSV: the column names, then a row a line, each number the shortest decimal that reads
/// back as the same double; a NaN is an empty field. Throws std::invalid_argument for a row that
/// has not as many values as there are columns.
std::string trace_csv(const RunTrace& trace);

/// The trace that such a text holds. Throws std::invalid_argument with the line that holds none.
RunTrace trace_of_csv(const std::string& text);

}  // namespace kestrel

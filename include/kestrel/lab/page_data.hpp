#pragma once

#include <string>

#include "kestrel/lab/lab_report.hpp"

namespace kestrel {

/// What the script of the page draws, as JSON that may stand inside a <script> element:
/// laws, scenarios, modifiers: names; scenes by scenario; runs: {s, m, l: places of these names,
/// end: words, ok, k: figures, t: times, c: {column: [resolution, numbers...]}}. Numbers are whole
/// units of the resolution, each as its difference from the one before, null for no value; times in
/// ms likewise. Runs without a trace have no t and c. The rows are thinned to `most_rows` a run.
std::string page_data(const LabReport& report, std::size_t most_rows);

}  // namespace kestrel

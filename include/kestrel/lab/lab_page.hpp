#pragma once

#include <string>

#include "kestrel/lab/lab_report.hpp"

namespace kestrel {

/// The report as one HTML page that needs no network and no other file: a table of outcomes, still
/// pictures of every scenario and modifier, and a script that draws any choice of laws from the
/// numbers in the page. Without scripts, and on paper, the still pictures show; with them they are
/// folded away. Light or dark as the reader prefers. Empty parts are left out.
std::string lab_page(const LabReport& report);

}  // namespace kestrel

#pragma once

#include <string>

#include "kestrel/io/axis.hpp"
#include "kestrel/io/svg_plot.hpp"

/// Names of lines beside their ends.
namespace kestrel::svg {

/// Width that the names of the series ask for right of the axes, px; 0 when they stand in a legend.
double line_end_width(const Plot& plot);

/// The names, each beside the last value of its line and joined to it, moved apart where they would
/// cover each other.
std::string line_ends(const Plot& plot, const Axis& x, const Axis& y);

}  // namespace kestrel::svg

#pragma once

#include <string>

#include "kestrel/io/axis.hpp"
#include "kestrel/io/svg_plot.hpp"

/// The lines and marks of a plot as SVG.
namespace kestrel::svg {

/// Classes of the style sheet for the series at this place of the plot.
std::string line_classes(const Series& series, std::size_t place);

/// The series along the axes, thinned; empty when no point has a place.
std::string path(const Series& series, std::size_t place, const Axis& x, const Axis& y);

/// The mark's shape about (x, y), px; empty when that is not finite.
std::string mark(const Mark& mark, double x, double y);

}  // namespace kestrel::svg

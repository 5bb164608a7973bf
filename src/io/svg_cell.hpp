#pragma once

#include <string>

/// The cells of a heat map as SVG.
namespace kestrel::svg {

/// A rectangle of the drawing, px.
struct CellBox {
  double x = 0;
  double y = 0;
  double width = 0;
  double height = 0;
};

/// Darkness 0 .. 1 as a colour, light yellow over green to dark blue: ordered in lightness, so
/// that it is read in grey too.
std::string shade(double share);

/// The box filled with a colour.
std::string filled(const CellBox& box, const std::string& colour);

/// Slanted (0: up, 1: down), upright (2) or lying (3) lines across the box; 4: both slants.
std::string hatch(const CellBox& box, int kind);

}  // namespace kestrel::svg

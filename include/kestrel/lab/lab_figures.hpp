#pragma once

#include <string>
#include <vector>

#include "kestrel/lab/lab_report.hpp"

namespace kestrel {

/// Still pictures (SVG documents) of all laws on one scenario under one modifier: trajectories in
/// the image, error over time, path in space, and bars (camera: retreat and approach; helicopter:
/// final position error). Empty when no run of them is there; runs without a trace have bars only.
/// The look of a law is the same in every picture of a report.
std::vector<std::string> scenario_figures(const LabReport& report, const std::string& scenario,
                                          const std::string& modifier);

/// Retreat over the angle of the scenarios that start with a pure rotation about the optical axis
/// of at most 165 deg, unmodified and converged, with Z* (1 / cos(angle / 2) - 1) (servo.md 2.1).
/// Laws that never retreat a millimetre are left out. Empty below two angles.
std::string retreat_figure(const LabReport& report);

/// The shares of starts from which each law arrived, in percent, with their intervals.
std::string basin_figure(const std::vector<LabBasin>& basins);

/// One law over two parameters.
std::string map_figure(const LabMap& map);

/// The slopes of the orders of accuracy.
std::string order_figure(const std::vector<LabOrder>& orders);

}  // namespace kestrel

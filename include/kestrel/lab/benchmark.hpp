#pragma once

#include <string>
#include <vector>

#include "kestrel/lab/camera_experiment.hpp"

namespace kestrel {

/// The scenarios of the 6-DOF benchmark, S0_tutorial .. S13_oblique: a square of 0.2 m, goal 0.75 m
/// in front of it.
const std::vector<Scenario>& benchmark_scenarios();

/// The modifiers the benchmark applies to S0_tutorial and S3_rz90 (names as modified() reads them).
const std::vector<std::string>& benchmark_modifiers();

/// Every law on every scenario, and on S0_tutorial and S3_rz90 with every modifier, in the order
/// of the tables: by scenario, then modifier, then law.
std::vector<CameraExperiment> benchmark_experiments(int trace_every);

}  // namespace kestrel

#pragma once

#include <cstdint>

#include "kestrel/eval/hover_metrics.hpp"
#include "kestrel/io/yaml_section.hpp"
#include "kestrel/sim/world.hpp"

#include "simulation_scene.hpp"

namespace kestrel::app {

/// How far a start may lie from the task's, either way, every place alike.
struct Scatter {
  Eigen::Vector3d position_ned_m = Eigen::Vector3d::Zero();
  double heading_rad = 0;
};

/// The start of this seed.
HelicopterState scattered(HelicopterState start, const Scatter& scatter, std::uint64_t seed);

/// The section `simulation` of a task file.
struct Simulation {
  WorldOptions world;
  SceneOptions scene;
  HoverGoal goal;
  Scatter scatter;
};

/// Reads the section: every key is optional. Throws FileError. Camera, mount and target size come
/// from the rest of the task.
Simulation read_simulation(const Section& section);

}  // namespace kestrel::app

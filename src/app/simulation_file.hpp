#pragma once

#include <cstdint>

#include "kestrel/eval/hover_metrics.hpp"
#include "kestrel/io/yaml_section.hpp"
#include "kestrel/sim/world.hpp"

#include "simulation_scene.hpp"

namespace kestrel::app {

/// The section `simulation` of a task file.
struct Simulation {
  WorldOptions world;
  SceneOptions scene;
  HoverGoal goal;
};

/// Reads the section: every key is optional. Throws FileError. Camera, mount and target size come
/// from the rest of the task.
Simulation read_simulation(const Section& section);

}  // namespace kestrel::app

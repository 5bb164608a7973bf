#pragma once

#include <cstdint>

#include "kestrel/eval/hover_metrics.hpp"
#include "kestrel/io/yaml_section.hpp"
#include "kestrel/sim/scene.hpp"
#include "kestrel/sim/world.hpp"

namespace kestrel::app {

/// The section `simulation` of a task file.
struct Simulation {
  WorldOptions world;
  WallOptions wall;
  std::filesystem::path texture;  // of the poster; empty: the built-in one
  HoverGoal goal;
};

/// Reads the section: every key is optional. Throws FileError. Camera, mount and target size come
/// from the rest of the task.
Simulation read_simulation(const Section& section);

/// The scene of a simulation: its poster on the wall.
Scene scene_of(const Simulation& simulation);

}  // namespace kestrel::app

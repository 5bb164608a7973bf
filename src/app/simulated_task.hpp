#pragma once

#include "kestrel/io/task_file.hpp"
#include "kestrel/link/autopilot_adapter.hpp"
#include "kestrel/sim/scene.hpp"
#include "kestrel/vision/tracker.hpp"

#include "arguments.hpp"
#include "simulation_file.hpp"

namespace kestrel::app {

/// A task that can be simulated, with the command line's wishes in it.
struct SimulatedTask {
  Experiment experiment;
  Simulation simulation;  // camera, mount and start filled in
  AutopilotOptions autopilot;
  Scene scene;
};

/// Reads the task file. Throws FileError, and what loading a picture throws.
SimulatedTask load_simulated_task(const SimulateArguments& arguments);

/// The task as a loop can hold it in a scene: the template is learned from the view at the goal, so
/// its size and place on the target are known to the pixel.
struct LearnedTask {
  Task task;
  Tracker tracker;
};

LearnedTask learned_at_goal(Task task, const Scene& scene);

}  // namespace kestrel::app

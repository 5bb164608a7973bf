#include "simulated_task.hpp"

#include <cmath>

#include "kestrel/sim/reference.hpp"

#include "autopilot_file.hpp"

namespace kestrel::app {

SimulatedTask load_simulated_task(const SimulateArguments& a) {
  Section file = Section::load(a.task);
  SimulatedTask loaded{
      read_experiment(file), read_simulation(file.child("simulation")), read_autopilot(file), {}};
  file.done();
  WorldOptions& world = loaded.simulation.world;
  world.camera = loaded.experiment.task.camera;
  world.body_from_camera = loaded.experiment.task.body_from_camera;
  if (a.seed) world.seed = std::uint64_t(*a.seed);
  world.start = scattered(world.start, loaded.simulation.scatter, world.seed);
  if (a.ground.port) world.frames.reset();  // until it is stopped
  if (a.duration_s) world.frames = std::int64_t(std::ceil(*a.duration_s * world.rate_hz));
  loaded.scene = scene_of(loaded.simulation.scene, loaded.experiment.task.target_width_m,
                          loaded.experiment.task.target_height_m);
  return loaded;
}

LearnedTask learned_at_goal(Task task, const Scene& scene) {
  const Reference reference = goal_view(scene, task.camera, task.goal);
  task.target_width_m = reference.width_m;
  task.target_height_m = reference.height_m;
  task.goal = task.goal * reference.target_from_template;
  return {task, Tracker(reference.image, reference.box, task.track)};
}

}  // namespace kestrel::app

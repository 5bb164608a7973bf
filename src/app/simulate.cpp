#include "simulate.hpp"

#include <cmath>

#include <fmt/format.h>

#include "kestrel/io/csv.hpp"
#include "kestrel/sim/outside_view.hpp"
#include "kestrel/sim/reference.hpp"

#include "autopilot_file.hpp"
#include "chain.hpp"
#include "flight_film.hpp"
#include "interrupt.hpp"
#include "simulation_file.hpp"
#include "sinks.hpp"
#include "task_setup.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

/// The pose of the helicopter from which the levelled camera sees the target, where it is now, as
/// the goal wants it.
Transform<frame::World, frame::Body> goal_in_world(const Task& task, const World& world) {
  return world.world_from_target() * task.goal.inverse() * task.body_from_camera.inverse();
}

double yaw_of(const Eigen::Matrix3d& world_from_body) {
  return std::atan2(world_from_body(1, 0), world_from_body(0, 0));
}

/// Where the flight is against its goal, by the truth of the world.
FlightSample sample(const World& world, const Frame& frame, bool seen,
                    const Transform<frame::World, frame::Body>& goal) {
  FlightSample s;
  s.stamp_s = frame.stamp_s;
  const Transform<frame::World, frame::Body>& at = world.motion().world_from_body;
  s.position_error_m = (at.translation - goal.translation).norm();
  s.heading_error_rad = wrap_angle(yaw_of(at.rotation) - yaw_of(goal.rotation));
  s.target_distance_m = world.camera_from_target().inverse().translation.z() * -1;
  s.seen = seen;
  return s;
}

/// Values of truth_columns(), in their order.
std::vector<double> truth(const World& world, const FlightSample& s,
                          const Transform<frame::World, frame::Body>& goal) {
  const Transform<frame::World, frame::Body>& at = world.motion().world_from_body;
  const Attitude a = attitude(at);
  const Eigen::Matrix3d turn = goal.rotation.transpose() * at.rotation;
  return {
      at.translation.x(), at.translation.y(),          at.translation.z(), a.roll, a.pitch, a.yaw,
      s.position_error_m, rotation_vector(turn).norm()};
}

/// One line of a TUM trajectory: time, position, quaternion x y z w of Body in World.
std::string tum_line(double stamp_s, const Transform<frame::World, frame::Body>& pose) {
  const Eigen::Vector3d& p = pose.translation;
  const Eigen::Vector3d theta_u = rotation_vector(pose.rotation);
  const double angle = theta_u.norm();
  const Eigen::Vector3d v =
      angle > 0 ? Eigen::Vector3d(theta_u / angle * std::sin(angle / 2)) : Eigen::Vector3d::Zero();
  return fmt::format("{} {} {} {} {} {} {} {}", number(stamp_s), number(p.x()), number(p.y()),
                     number(p.z()), number(v.x()), number(v.y()), number(v.z()),
                     number(std::cos(angle / 2)));
}

Summary summarise(const HoverMetrics& m, const ChainEnd& end, const CommandSink& sink,
                  const Task& task) {
  Summary summary;
  summary.begin_section("flight");
  summary.add("result", name(m.end));
  summary.add("settled after", m.settled_s.value_or(std::nan("")), "s");
  summary.add("final position error", m.final_position_m, "m");
  summary.add("final heading error", m.final_heading_rad * 180 / M_PI, "deg");
  summary.add("target seen", m.seen_share * 100, "%");
  summary.add("longest time unseen", m.longest_unseen_s, "s");
  summary.begin_section("chain");
  add_chain(summary, end, sink);
  add_timing(summary, end, task);
  return summary;
}

/// The task as the simulator can hold it: the template learned from the view at the goal, so its
/// size and place on the target are known to the pixel.
struct Prepared {
  Task task;
  Tracker tracker;
};

Prepared prepare(Task task, const Scene& scene) {
  const Reference reference = goal_view(scene, task.camera, task.goal);
  task.target_width_m = reference.width_m;
  task.target_height_m = reference.height_m;
  task.goal = task.goal * reference.target_from_template;
  return {task, Tracker(reference.image, reference.box, task.track)};
}

/// What a recorded flight is called: several of one task lie side by side.
std::string film_name(const SimulateArguments& a) {
  const std::string stem = a.task.stem().string();
  return a.seed ? fmt::format("{}_seed_{}", stem, *a.seed) : stem;
}

}  // namespace

SimulatedFlight fly(const SimulateArguments& a) {
  Section file = Section::load(a.task);
  Experiment experiment = read_experiment(file);
  Simulation simulation = read_simulation(file.child("simulation"));
  const AutopilotOptions autopilot = read_autopilot(file);
  file.done();
  simulation.world.camera = experiment.task.camera;
  simulation.world.body_from_camera = experiment.task.body_from_camera;
  if (a.seed) simulation.world.seed = std::uint64_t(*a.seed);
  simulation.world.start =
      scattered(simulation.world.start, simulation.scatter, simulation.world.seed);
  if (a.duration_s) {
    simulation.world.frames = std::int64_t(std::ceil(*a.duration_s * simulation.world.rate_hz));
  }
  const Scene scene =
      scene_of(simulation.scene, experiment.task.target_width_m, experiment.task.target_height_m);
  World world(scene, simulation.world);
  const Task task = experiment.task;  // its goal is that of the target, not of the template
  Prepared prepared = prepare(task, scene);
  const Sink outside = open_sink(a.sink, autopilot, std::nullopt);
  TeeSink sink(world, *outside.commands);
  RunRecorder recorder(recorder_options(a.run, a.task, simulation.world.rate_hz, truth_columns()));
  LineFile trajectory(recorder.folder() / "trajectory.tum");

  std::optional<FlightFilm> film;
  if (!a.record.empty()) film.emplace(a.record, film_name(a), scene, simulation.world);

  std::vector<FlightSample> flight;
  double path_m = 0;
  Eigen::Vector3d before_m = world.motion().world_from_body.translation;
  const auto watch = [&](const Frame& frame, const Step& step,
                         LogRow& row) -> std::optional<std::string> {
    const auto goal = goal_in_world(task, world);
    if (film) film->record(frame, world);
    flight.push_back(sample(world, frame, step.track.found(), goal));
    row.extra = truth(world, flight.back(), goal);
    path_m += (world.motion().world_from_body.translation - before_m).norm();
    before_m = world.motion().world_from_body.translation;
    trajectory.write(tum_line(frame.stamp_s, world.motion().world_from_body));
    const auto end = ended(flight, simulation.goal);
    if (!end) return std::nullopt;
    return name(*end);
  };
  Chain chain{world, sink, prepared.tracker, prepared.task, recorder};
  chain.velocity = [&world](double) { return world.measured_velocity_m_s(); };
  chain.age_s = [late = simulation.world.imaging.latency_s](double) { return late; };
  std::optional<OutsideView> outside_view;
  if (a.run.video || a.run.display) {
    chain.beside = [&](const Frame& frame, cv::Size size) {
      const Eigen::Vector3d goal_m = goal_in_world(task, world).translation;
      const auto& body = world.motion().world_from_body;
      if (!outside_view) outside_view.emplace(scene, body.translation, goal_m, size);
      return outside_view->draw(body, task.body_from_camera, goal_m, frame.stamp_s);
    };
  }
  const ChainEnd end = run_chain(chain, *world.next(), watch);
  const HoverMetrics metrics = hover_metrics(flight, simulation.goal);
  RunResult result{recorder.folder(), summarise(metrics, end, sink, prepared.task), 0};
  if (outside.report) outside.report(result.summary);
  recorder.add_times(result.summary);
  finish_run(recorder, prepared.tracker.model(), prepared.task, end, result.summary,
             "Simulated flight: " + a.task.stem().string(), simulate_sections);
  if (end.broken || metrics.end != FlightEnd::Converged) result.exit_code = 1;
  if (interrupted()) result.exit_code = kInterrupted;
  return {result, metrics, path_m};
}

RunResult simulate(const SimulateArguments& arguments) { return fly(arguments).run; }

int run(const SimulateArguments& arguments) {
  if (arguments.seeds) return fly_seeds(arguments);
  const RunResult result = simulate(arguments);
  print_result(result);
  return result.exit_code;
}

}  // namespace kestrel::app

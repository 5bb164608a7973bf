#include "simulate.hpp"

#include <cmath>

#include <fmt/format.h>

#include "kestrel/io/csv.hpp"
#include "kestrel/sim/outside_view.hpp"

#include "chain.hpp"
#include "flight_film.hpp"
#include "flight_truth.hpp"
#include "ground.hpp"
#include "interrupt.hpp"
#include "real_time.hpp"
#include "simulated_task.hpp"
#include "sinks.hpp"
#include "task_setup.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

FlightMoment moment_of(const World& world, double stamp_s) {
  return {stamp_s, world.motion().world_from_body, world.world_from_target()};
}

Summary summarise(const HoverMetrics& m, const ChainEnd& end, const CommandSink& sink,
                  const Task& task) {
  Summary summary;
  add_flight(summary, m);
  summary.begin_section("chain");
  add_chain(summary, end, sink);
  add_timing(summary, end, task);
  return summary;
}

/// What a recorded flight is called: several of one task lie side by side.
std::string film_name(const SimulateArguments& a) {
  const std::string stem = a.task.stem().string();
  return a.seed ? fmt::format("{}_seed_{}", stem, *a.seed) : stem;
}

}  // namespace

SimulatedFlight fly(const SimulateArguments& a) {
  const SimulatedTask loaded = load_simulated_task(a);
  const Simulation& simulation = loaded.simulation;
  const Scene& scene = loaded.scene;
  World world(scene, simulation.world);
  const Task& task = loaded.experiment.task;  // its goal is that of the target, not of the template
  LearnedTask prepared = learned_at_goal(task, scene);
  const Sink outside = open_sink(a.sink, loaded.autopilot, std::nullopt);
  Ground ground(a.ground, prepared.task, *outside.commands, outside.facts);
  TeeSink sink(world, ground.sink());
  std::optional<FlightFilm> film;
  if (!a.record.empty()) film.emplace(a.record, film_name(a), scene, simulation.world);
  RunRecorder recorder(recorder_options(a.run, a.task, simulation.world.rate_hz, truth_columns()));
  LineFile trajectory(recorder.folder() / "trajectory.tum");

  std::vector<FlightSample> flight;
  double path_m = 0;
  Eigen::Vector3d before_m = world.motion().world_from_body.translation;
  const auto watch = [&](const Frame& frame, const Step& step,
                         LogRow& row) -> std::optional<std::string> {
    if (film) film->record(frame, world);
    const FlightMoment now = moment_of(world, frame.stamp_s);
    flight.push_back(flight_sample(now, task));
    flight.back().seen = step.track.found();
    row.extra = truth_values(now, task);
    path_m += (world.motion().world_from_body.translation - before_m).norm();
    before_m = world.motion().world_from_body.translation;
    trajectory.write(tum_line(frame.stamp_s, world.motion().world_from_body));
    const auto end = ended(flight, simulation.goal);
    const bool goes_on = ground.station() && (end == FlightEnd::Converged ||
                                              end == FlightEnd::TargetLost);  // the operator's
    if (!end || goes_on) return std::nullopt;
    return name(*end);
  };
  Chain chain{world, sink, prepared.tracker, prepared.task, recorder};
  chain.ground = ground.station();
  chain.steered = ground.steering();
  if (a.run.display && !chain.ground) chain.start = Start::Paused;
  if (chain.ground || a.run.display || outside.lives_by_the_clock) chain.pace = Pace::RealTime;
  chain.velocity = [&world](double) { return world.measured_velocity_m_s(); };
  chain.age_s = [late = simulation.world.imaging.latency_s](double) { return late; };
  std::optional<OutsideView> outside_view;
  if (a.run.video || a.run.display) {
    chain.beside = [&](const Frame& frame, cv::Size size) {
      const Eigen::Vector3d goal_m = goal_in_world(task, world.world_from_target()).translation;
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
  if (arguments.real_time) return simulate_in_real_time(arguments);
  if (arguments.seeds) return fly_seeds(arguments);
  SimulateArguments at_terminal = arguments;
  at_terminal.ground.keys = true;
  const RunResult result = simulate(at_terminal);
  print_result(result);
  return result.exit_code;
}

}  // namespace kestrel::app

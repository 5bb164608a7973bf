#include "real_time.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "kestrel/io/csv.hpp"
#include "kestrel/io/run_figures.hpp"
#include "kestrel/io/run_folder.hpp"

#include "camera_by_the_clock.hpp"
#include "flight_truth.hpp"
#include "interrupt.hpp"
#include "simulated_task.hpp"
#include "vehicle_server.hpp"
#include "verbs.hpp"
#include "watched_vehicle.hpp"

namespace kestrel::app {
namespace {

constexpr double kReportsKnownAfter_s = 0.05;  // two periods of 50 Hz and a line

/// What flies: the built-in helicopter, or a vehicle that is only looked at.
struct FlyingThing {
  CameraByTheClock::MotionAt motion_at;
  double known_after_s = 0;
  std::function<std::vector<std::string>()> take_events;
  std::function<void(Summary&)> report;
};

/// The ground of the scene, m down: that of its first plane but for a wall's own options.
double ground_down_m(const SimulatedTask& task) {
  return task.scene.planes.front().world_from_target.translation.z();
}

FlyingThing built_in(const SimulatedTask& task, const RealTimeArguments& a) {
  FlyingVehicleOptions options;
  options.rules.autopilot = a.autopilot;
  options.rules.starts_armed = a.starts_in_air;
  options.vehicle = task.simulation.world.vehicle;
  options.start = task.simulation.world.start;
  options.ground_down_m = ground_down_m(task);
  options.seed = task.simulation.world.seed;
  const auto server =
      std::make_shared<VehicleServer>(Address{"127.0.0.1", a.vehicle_port}, options);
  fmt::print(stderr, "vehicle: {} at {}\n", name(a.autopilot), to_string(server->local()));
  return {[server](double clock_s) { return server->motion_at(clock_s); }, 0,
          [server] { return server->take_events(); },
          [server](Summary& summary) { server->report(summary); }};
}

FlyingThing watched(const SimulatedTask& task, const RealTimeArguments& a) {
  const Eigen::Vector3d& start = task.simulation.world.start.position_m;
  Eigen::Vector3d origin(start.x(), start.y(), ground_down_m(task));
  if (!a.origin_ned_m.empty()) origin = Eigen::Vector3d(a.origin_ned_m.data());
  const Address at = watched_address(a.vehicle);
  const auto vehicle = std::make_shared<WatchedVehicle>(at, origin);
  fmt::print(stderr, "looking at the vehicle at {}; its local frame begins at {}, {}, {} m\n",
             to_string(at), origin.x(), origin.y(), origin.z());
  return {[vehicle](double clock_s) { return vehicle->motion_at(clock_s); }, kReportsKnownAfter_s,
          [] { return std::vector<std::string>(); },
          [vehicle](Summary& summary) { vehicle->report(summary); }};
}

/// The truth of the flight, in memory and in the run folder.
class TruthRecord {
 public:
  TruthRecord(const std::filesystem::path& folder, const SimulatedTask& task)
      : task_(task), table_(folder / "truth.csv"), trajectory_(folder / "trajectory.tum") {
    std::string head = "frame,time_s";
    for (const std::string& column : truth_columns()) head += "," + column;
    table_.write(head + ",heading_error_rad,speed_m_s");
  }

  /// The end the flight has come to, if it cannot go on.
  std::optional<FlightEnd> add(const Exposure& e) {
    const TexturedPlane& plane = task_.scene.target_plane();
    const FlightMoment now{e.stamp_s, e.vehicle.world_from_body, pose(plane, e.stamp_s)};
    FlightSample sample = flight_sample(now, task_.experiment.task);
    sample.seen = is_in_view(now);
    std::string line = fmt::format("{},{:.6f}", e.number, e.stamp_s);
    for (const double value : truth_values(now, task_.experiment.task)) line += "," + number(value);
    table_.write(fmt::format("{},{},{}", line, number(sample.heading_error_rad),
                             number(e.vehicle.velocity_m_s.norm())));
    trajectory_.write(tum_line(e.stamp_s, e.vehicle.world_from_body));
    flight_.push_back(sample);
    const auto end = ended({sample}, task_.simulation.goal);
    return end;
  }

  HoverMetrics metrics() const { return hover_metrics(flight_, task_.simulation.goal); }

 private:
  /// The target's centre in the picture: whether a tracker finds it is another question.
  bool is_in_view(const FlightMoment& now) const {
    const Camera& camera = task_.simulation.world.camera;
    const Eigen::Vector3d p =
        ((now.body * task_.simulation.world.body_from_camera).inverse() * now.target).translation;
    if (!(p.z() > 0)) return false;
    const Pixel at = camera.to_pixel({p.x() / p.z(), p.y() / p.z()});
    return at.u >= 0 && at.v >= 0 && at.u < camera.parameters().width &&
           at.v < camera.parameters().height;
  }

  const SimulatedTask& task_;
  LineFile table_;
  LineFile trajectory_;
  std::vector<FlightSample> flight_;
};

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void add_camera(Summary& summary, const CameraByTheClock& camera, const FrameServerCounts& served) {
  const CameraCounts& c = camera.counts();
  summary.begin_section("camera");
  summary.add("frames rendered", c.rendered);
  summary.add("left out: late", c.late);
  summary.add("left out: drop_share", c.dropped);
  summary.add("left out: place not known", c.unknown);
  summary.add("frames sent", std::int64_t(served.sent));
  summary.add("replaced by a newer one", std::int64_t(served.replaced));
  summary.add("readers", std::int64_t(served.readers));
  summary.add("rendering, median", median(camera.render_ms()), "ms");
}

/// Turns until it is over: Ctrl-C, --duration, or a flight that cannot go on.
void turn_until_over(const SimulateArguments& a, CameraByTheClock& camera, const FlyingThing& thing,
                     TruthRecord& truth) {
  while (!interrupted() && !(a.duration_s && camera.now_s() >= *a.duration_s)) {
    const auto exposure = camera.turn();
    for (const std::string& event : thing.take_events()) fmt::print("{}\n", event);
    std::fflush(stdout);
    if (!exposure) continue;
    if (const auto end = truth.add(*exposure)) {
      fmt::print(stderr, "the flight is over: {}\n", name(*end));
      return;
    }
  }
}

}  // namespace

int simulate_in_real_time(const SimulateArguments& a) {
  const SimulatedTask task = load_simulated_task(a);
  const WorldOptions& world = task.simulation.world;
  world.check();
  const OnboardCamera eye(task.scene,
                          {world.camera, world.body_from_camera, world.imaging, world.seed});
  FrameServer server(parse_frame_place(a.real_time->frames));
  const FlyingThing thing =
      a.real_time->vehicle.empty() ? built_in(task, *a.real_time) : watched(task, *a.real_time);
  const std::filesystem::path folder = create_run_folder(
      a.run.output.empty() ? std::filesystem::path("runs") / a.task.stem() : a.run.output);
  fmt::print(stderr, "frames: sim:{}; Ctrl-C ends\n", to_string(server.place()));
  TruthRecord truth(folder, task);
  CameraByTheClock camera(eye, server, thing.motion_at, world.rate_hz, world.imaging.latency_s,
                          thing.known_after_s);
  turn_until_over(a, camera, thing, truth);

  const HoverMetrics metrics = truth.metrics();
  Summary summary;
  add_flight(summary, metrics);
  thing.report(summary);
  add_camera(summary, camera, server.counts());
  write_summary(folder / "summary.json", summary);
  fmt::print("{}\nrun folder: {}\n", text_table(summary), folder.string());
  if (interrupted()) return kInterrupted;
  return metrics.end == FlightEnd::Converged ? 0 : 1;
}

}  // namespace kestrel::app

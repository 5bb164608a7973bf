// Steps of the rigid helicopter under its flight controller: a table on standard output and, in a
// folder, the pictures of doc/simulation.md. helicopter_steps FOLDER
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "kestrel/geometry/attitude.hpp"
#include "kestrel/io/csv.hpp"
#include "kestrel/io/svg_plot.hpp"
#include "kestrel/sim/helicopter.hpp"
#include "kestrel/sim/vehicle.hpp"

namespace {

using kestrel::Series;
using kestrel::Vehicle;
using kestrel::VelocityCommand;

constexpr double kStep_s = 0.01;
constexpr double kDegree = M_PI / 180;

/// A flight as it is looked at: times and, at each, velocity in the heading frame with the yaw
/// rate, roll and pitch.
struct Flight {
  std::vector<double> time_s;
  std::vector<Eigen::Vector4d> velocity;
  std::vector<double> roll_deg;
  std::vector<double> pitch_deg;
};

void look(Flight& flight, const Vehicle& vehicle, double time_s) {
  const kestrel::TrueMotion& m = vehicle.motion();
  const kestrel::Attitude a = kestrel::attitude(m.world_from_body);
  const double c = std::cos(a.yaw);
  const double s = std::sin(a.yaw);
  const Eigen::Vector3d& v = m.velocity_m_s;
  flight.time_s.push_back(time_s);
  flight.velocity.emplace_back(c * v.x() + s * v.y(), c * v.y() - s * v.x(), v.z(),
                               m.rate_rad_s.z());
  flight.roll_deg.push_back(a.roll / kDegree);
  flight.pitch_deg.push_back(a.pitch / kDegree);
}

Flight flown(const kestrel::VehicleOptions& options, const VelocityCommand& until,
             const VelocityCommand& then, double change_s, double end_s) {
  Vehicle vehicle(options, {}, 1);
  Flight flight;
  look(flight, vehicle, 0);
  for (int i = 1; i * kStep_s <= end_s; ++i) {
    vehicle.advance((i - 1) * kStep_s < change_s ? until : then, kStep_s);
    look(flight, vehicle, i * kStep_s);
  }
  return flight;
}

Flight step(const kestrel::VehicleOptions& options, const VelocityCommand& command) {
  return flown(options, command, command, 0, 6);
}

/// The first time at which the axis has passed this share of the command.
double passes_s(const Flight& flight, int axis, double level) {
  for (std::size_t i = 0; i < flight.time_s.size(); ++i) {
    if (flight.velocity[i][axis] / level >= 1) return flight.time_s[i];
  }
  return std::nan("");
}

void print_step(const char* name, const Flight& flight, int axis, double command) {
  double most = 0;
  double roll = 0;
  double pitch = 0;
  for (std::size_t i = 0; i < flight.time_s.size(); ++i) {
    most = std::max(most, flight.velocity[i][axis] / command);
    roll = std::max(roll, std::abs(flight.roll_deg[i] - flight.roll_deg.front()));
    pitch = std::max(pitch, std::abs(flight.pitch_deg[i]));
  }
  std::printf(
      "%-22s 63 %% after %4.2f s, 90 %% after %4.2f s, overshoot %4.1f %%, tilts %4.1f deg\n", name,
      passes_s(flight, axis, 0.632 * command), passes_s(flight, axis, 0.9 * command),
      (most - 1) * 100, std::max(roll, pitch));
}

Series series(const std::string& name, const Flight& flight, int axis, double scale) {
  Series s;
  s.name = name;
  s.x = flight.time_s;
  for (const Eigen::Vector4d& v : flight.velocity) s.y.push_back(v[axis] * scale);
  return s;
}

/// A first-order answer to a unit step, as a comparison.
Series lag(const std::string& name, double time_constant_s) {
  Series s;
  s.name = name;
  s.stroke = kestrel::Stroke::Dashed;
  for (int i = 0; i <= 600; ++i) {
    s.x.push_back(i * kStep_s);
    s.y.push_back(1 - std::exp(-i * kStep_s / time_constant_s));
  }
  return s;
}

void print_attitude(const Flight& hard) {
  double most = 0;
  double rate = 0;
  double reached_s = 0;
  for (std::size_t i = 1; i < hard.time_s.size(); ++i) {
    const double pitch = std::abs(hard.pitch_deg[i]);
    most = std::max(most, pitch);
    rate = std::max(rate, std::abs(hard.pitch_deg[i] - hard.pitch_deg[i - 1]) / kStep_s);
    if (reached_s == 0 && pitch >= 0.632 * 20) reached_s = hard.time_s[i];
  }
  std::printf(
      "asked for 20 m/s:      pitches %4.1f deg at most (limit 20), 63 %% of it after %4.2f s, "
      "%4.0f deg/s at most\n",
      most, reached_s, rate);
}

void print_stop(const Flight& stop, double from_s) {
  double stopped_s = 0;
  double way_m = 0;
  for (std::size_t i = 0; i < stop.time_s.size(); ++i) {
    if (stop.time_s[i] < from_s) continue;
    way_m += stop.velocity[i][0] * kStep_s;
    if (std::abs(stop.velocity[i][0]) > 0.1) stopped_s = stop.time_s[i] - from_s;
  }
  std::printf("from 1 m/s to hover:   below 0.1 m/s after %4.2f s, %4.2f m on\n", stopped_s, way_m);
}

void write(const std::filesystem::path& file, const std::string& title, const std::string& y_label,
           const std::vector<Series>& lines, const std::vector<kestrel::Limit>& limits = {}) {
  kestrel::Plot plot;
  plot.title = title;
  plot.x_label = "time, s";
  plot.y_label = y_label;
  plot.series = lines;
  plot.limits = limits;
  kestrel::write_text(file, kestrel::svg_plot(plot));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: helicopter_steps FOLDER\n", stderr);
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const kestrel::RotorcraftSystem rigid;
  const kestrel::HelicopterOptions loops;
  const Flight forward = step(rigid, {1, 0, 0, 0});
  const Flight right = step(rigid, {0, 1, 0, 0});
  const Flight left = step(rigid, {0, -1, 0, 0});
  const Flight down = step(rigid, {0, 0, 1, 0});
  const Flight up = step(rigid, {0, 0, -1, 0});
  const Flight turn = step(rigid, {0, 0, 0, 0.4});
  const Flight hard = step(rigid, {20, 0, 0, 0});
  print_step("forward 1 m/s", forward, 0, 1);
  print_step("right 1 m/s", right, 1, 1);
  print_step("left 1 m/s", left, 1, -1);
  print_step("down 1 m/s", down, 2, 1);
  print_step("up 1 m/s", up, 2, -1);
  print_step("yaw rate 0.4 rad/s", turn, 3, 0.4);
  print_step("loops: forward 1 m/s", step(loops, {1, 0, 0, 0}), 0, 1);
  print_attitude(hard);
  print_stop(flown(rigid, {1, 0, 0, 0}, {}, 6, 14), 6);
  std::printf("roll in hover:         %.2f deg to the right, against the tail rotor\n",
              forward.roll_deg.front());
  write(folder / "steps.svg", "Steps of the rigid helicopter, and first-order lags",
        "velocity / command",
        {series("forward", forward, 0, 1), series("right", right, 1, 1), series("down", down, 2, 1),
         series("yaw rate", turn, 3, 1 / 0.4), lag("1/(1 + s): ArduPilot's PSC_VELXY_P 1", 1.0)});
  Series pitch;
  pitch.name = "pitch, 20 m/s forward asked for";
  pitch.x = hard.time_s;
  for (const double p : hard.pitch_deg) pitch.y.push_back(-p);
  write(folder / "tilt.svg", "Tilt at the limit", "nose down, deg", {pitch},
        {{20, "limit"}, {30, "ArduPilot's ANGLE_MAX"}});
  return 0;
}

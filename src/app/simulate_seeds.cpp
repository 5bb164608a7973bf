#include <fstream>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "kestrel/io/csv.hpp"
#include "kestrel/io/run_folder.hpp"
#include "kestrel/io/text_file.hpp"

#include "interrupt.hpp"
#include "simulate.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

struct Row {
  std::int64_t seed = 0;
  HoverMetrics metrics;
  double path_m = 0;
};

constexpr double kDegree = M_PI / 180;

std::string text_row(const Row& r) {
  const HoverMetrics& m = r.metrics;
  const std::string settled = m.settled_s ? fmt::format("{:.1f}", *m.settled_s) : "-";
  return fmt::format("{:>5}  {:<12} {:>9} {:>11.3f} {:>11.2f} {:>8.1f} {:>8.1f}", r.seed,
                     name(m.end), settled, m.final_position_m, m.final_heading_rad / kDegree,
                     m.seen_share * 100, r.path_m);
}

nlohmann::ordered_json json_row(const Row& r) {
  const HoverMetrics& m = r.metrics;
  nlohmann::ordered_json row;
  row["seed"] = r.seed;
  row["result"] = name(m.end);
  row["settled_s"] = m.settled_s ? nlohmann::ordered_json(*m.settled_s) : nullptr;
  row["final_position_m"] = m.final_position_m;
  row["final_heading_deg"] = m.final_heading_rad / kDegree;
  row["seen_percent"] = m.seen_share * 100;
  row["longest_unseen_s"] = m.longest_unseen_s;
  row["path_m"] = r.path_m;
  return row;
}

std::string csv_row(const Row& r) {
  const HoverMetrics& m = r.metrics;
  return fmt::format("{},{},{},{},{},{},{}", r.seed, name(m.end),
                     m.settled_s ? number(*m.settled_s) : "", number(m.final_position_m),
                     number(m.final_heading_rad / kDegree), number(m.seen_share * 100),
                     number(r.path_m));
}

}  // namespace

int fly_seeds(const SimulateArguments& arguments) {
  const std::filesystem::path folder = create_run_folder(
      arguments.run.output.empty() ? std::filesystem::path("runs") / arguments.task.stem()
                                   : arguments.run.output);
  LineFile csv(folder / "flights.csv");
  csv.write("seed,result,settled_s,final_position_m,final_heading_deg,seen_percent,path_m");
  nlohmann::ordered_json flights = nlohmann::ordered_json::array();
  fmt::print(" seed  result       settled s  position m  heading deg   seen %   path m\n");
  long converged = 0;
  for (std::int64_t seed = arguments.seeds->first; seed <= arguments.seeds->last && !interrupted();
       ++seed) {
    SimulateArguments one = arguments;
    one.seeds.reset();
    one.seed = seed;
    one.run.output = folder / fmt::format("seed_{}", seed);
    const SimulatedFlight flight = fly(one);
    if (flight.run.exit_code == kInterrupted) break;
    const Row row{seed, flight.metrics, flight.path_m};
    converged += row.metrics.end == FlightEnd::Converged ? 1 : 0;
    csv.write(csv_row(row));
    flights.push_back(json_row(row));
    fmt::print("{}\n", text_row(row));
    std::fflush(stdout);
  }
  write_text(folder / "flights.json", flights.dump(2) + "\n");
  fmt::print("{} of {} converged; folder: {}\n", converged, flights.size(), folder.string());
  if (interrupted()) return kInterrupted;
  return converged == long(flights.size()) ? 0 : 1;
}

}  // namespace kestrel::app

#include "kestrel/eval/hover_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace kestrel {
namespace {

bool at_goal(const FlightSample& sample, const HoverGoal& goal) {
  return sample.position_error_m <= goal.position_m &&
         std::abs(sample.heading_error_rad) <= goal.heading_rad;
}

/// First of the samples at the end that are all at the goal; the flight's size when none is.
std::size_t settled_from(const std::vector<FlightSample>& flight, const HoverGoal& goal) {
  std::size_t first = flight.size();
  while (first > 0 && at_goal(flight[first - 1], goal)) --first;
  return first;
}

/// Time since the target was last seen, or since the start.
double unseen_s(const std::vector<FlightSample>& flight, std::size_t last) {
  std::size_t i = last;
  while (i > 0 && !flight[i].seen) --i;
  return flight[last].stamp_s - flight[i].stamp_s;
}

}  // namespace

void HoverGoal::check() const {
  const auto require = [](double value, const char* what) {
    if (!(std::isfinite(value) && value > 0)) {
      throw std::invalid_argument(std::string(what) + ": must be positive and finite");
    }
  };
  require(position_m, "position_m");
  require(heading_rad, "heading");
  require(hold_s, "hold_s");
  require(collision_m, "collision_m");
  require(diverged_m, "diverged_m");
  require(lost_s, "lost_s");
}

std::optional<FlightEnd> ended(const std::vector<FlightSample>& flight, const HoverGoal& goal) {
  if (flight.empty()) return std::nullopt;
  const FlightSample& now = flight.back();
  const bool finite = std::isfinite(now.position_error_m) && std::isfinite(now.heading_error_rad) &&
                      std::isfinite(now.target_distance_m);
  if (!finite || now.position_error_m > goal.diverged_m) return FlightEnd::Diverged;
  if (now.target_distance_m < goal.collision_m) return FlightEnd::Collision;
  if (unseen_s(flight, flight.size() - 1) > goal.lost_s) return FlightEnd::TargetLost;
  const std::size_t first = settled_from(flight, goal);
  if (first < flight.size() && now.stamp_s - flight[first].stamp_s >= goal.hold_s) {
    return FlightEnd::Converged;
  }
  return std::nullopt;
}

HoverMetrics hover_metrics(const std::vector<FlightSample>& flight, const HoverGoal& goal) {
  HoverMetrics metrics;
  if (flight.empty()) return metrics;
  metrics.end = ended(flight, goal).value_or(FlightEnd::TimedOut);
  const std::size_t first = settled_from(flight, goal);
  if (first < flight.size()) metrics.settled_s = flight[first].stamp_s;
  metrics.final_position_m = flight.back().position_error_m;
  metrics.final_heading_rad = flight.back().heading_error_rad;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < flight.size(); ++i) {
    seen += flight[i].seen ? 1 : 0;
    metrics.longest_unseen_s = std::max(metrics.longest_unseen_s, unseen_s(flight, i));
  }
  metrics.seen_share = double(seen) / double(flight.size());
  return metrics;
}

const char* name(FlightEnd end) {
  switch (end) {
    case FlightEnd::Converged:
      return "converged";
    case FlightEnd::Collision:
      return "collision";
    case FlightEnd::Diverged:
      return "diverged";
    case FlightEnd::TargetLost:
      return "target lost";
    case FlightEnd::TimedOut:
      return "timed out";
  }
  return "unknown";
}

}  // namespace kestrel

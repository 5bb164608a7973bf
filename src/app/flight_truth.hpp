#pragma once

#include <string>
#include <vector>

#include "kestrel/eval/hover_metrics.hpp"
#include "kestrel/geometry/frames.hpp"
#include "kestrel/geometry/transform.hpp"
#include "kestrel/io/summary.hpp"
#include "kestrel/loop/task.hpp"

namespace kestrel::app {

/// Where the helicopter and the target really are at one moment.
struct FlightMoment {
  double stamp_s = 0;
  Transform<frame::World, frame::Body> body;
  Transform<frame::World, frame::Target> target;
};

/// The pose of the helicopter from which the levelled camera sees the target, where it is now, as
/// the task's goal wants it.
Transform<frame::World, frame::Body> goal_in_world(
    const Task& task, const Transform<frame::World, frame::Target>& target);

/// Where the flight is against its goal; `seen` is left false.
FlightSample flight_sample(const FlightMoment& now, const Task& task);

/// Values of truth_columns(), in their order.
std::vector<double> truth_values(const FlightMoment& now, const Task& task);

/// One line of a TUM trajectory: time, position, quaternion x y z w of Body in World.
std::string tum_line(double stamp_s, const Transform<frame::World, frame::Body>& pose);

/// What became of a flight, as lines of a summary.
void add_flight(Summary& summary, const HoverMetrics& metrics);

}  // namespace kestrel::app

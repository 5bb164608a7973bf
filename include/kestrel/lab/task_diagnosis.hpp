#pragma once

#include <vector>

#include "kestrel/lab/finding.hpp"
#include "kestrel/lab/helicopter_run.hpp"
#include "kestrel/loop/task.hpp"

namespace kestrel {

/// How fast the loop of a task is.
struct TaskTiming {
  double rate_hz = 30;   // commands per second
  double latency_s = 0;  // from the capture of an image to its command on the vehicle

  /// Throws std::invalid_argument that names the one out of range.
  void check() const;
};

/// The built-in helicopter flying this task at this timing from beside its goal: the law and the
/// freedom as variant vp4 (four), vp3 (three) or drop6 (six), 640 x 480 pixels when the camera file
/// does not say how many. Times are rounded to the plant's frames of 1/30 s.
HelicopterSetup helicopter_setup(const Task& task, const TaskTiming& timing);

/// Whether a task can converge, and with which gain, before anything flies. Looked at: jacobian
/// (rank and condition at the goal, and the motion the image hardly shows), noise (what a pixel of
/// it commands), gain (against the closed-form limit of an integrator, 2 sin(pi / (2 (2 d + 1))) /
/// T, and the built-in helicopter's by bisection), sign (what the law commands for a target to the
/// right, below and too far, in words), start (flights of the built-in helicopter from 24 places
/// around the goal with the target in view: how many arrive, and how the others end). Faults first.
std::vector<Finding> diagnosis(const Task& task, const TaskTiming& timing);

}  // namespace kestrel

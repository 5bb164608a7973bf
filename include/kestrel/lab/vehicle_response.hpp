#pragma once

#include <array>
#include <optional>

#include "kestrel/io/run_log.hpp"
#include "kestrel/loop/task.hpp"

namespace kestrel {

/// How the image answered the commands along one axis (forward, right, down, yaw).
struct AxisResponse {
  /// Image motion seen over the one the command and the task's mount, camera and sizes predict: 1
  /// when all is right, negative when the vehicle moves the other way, k when it is k times as fast
  /// (or, for translations, the target 1/k of the size the task says).
  double gain = 0;
  double standard_error = 0;  // of gain
  double latency_s = 0;       // from a command to its motion in the image: delay and lag
};

/// How the image answered all commands of a run.
struct VehicleResponse {
  /// By axis: forward, right, down, yaw; empty for an axis that was hardly used, or that cannot be
  /// told from the others (standard error above 0.3).
  std::array<std::optional<AxisResponse>, 4> axes;
  double explained = 0;  // share of the image motion's variance, 0 to 1
  int pairs = 0;         // of frames, used
};

/// The least-squares fit of the changes of the feature errors between frames 0.25 s apart to
/// L cVb S4 times the way the commands have carried the vehicle, a gain for each axis. Of the
/// vehicle it takes for granted only that it follows: after a delay (0 to 2 s, the same for all
/// axes) and with a first-order lag (0 to 1.3 s; one for forward and right), the best of a grid.
/// Standard errors count neighbouring frames as dependent (the residuals' autocorrelation time).
/// Empty with fewer than 12 such pairs (3 s), or without any motion.
std::optional<VehicleResponse> vehicle_response(const LogFile& log, const Task& task);

/// "forward", "right", "down", "yaw".
const char* axis_name(int axis);

}  // namespace kestrel

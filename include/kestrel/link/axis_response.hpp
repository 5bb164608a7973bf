#pragma once

#include <string>

#include "kestrel/geometry/attitude.hpp"
#include "kestrel/link/telemetry.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// A way the vehicle can be asked to move, one axis at a time.
enum class MotionAxis { Forward, Right, Down, Yaw };

/// "forward", "right", "down", "yaw"; of the other way "back", "left", "up", "yaw left".
const char* name(MotionAxis axis);
const char* opposite_name(MotionAxis axis);

/// The command that moves this axis alone, by m/s or rad/s.
VelocityCommand along(MotionAxis axis, double rate);

/// What the vehicle did between two moments: metres forward, right, down in the heading it had at
/// the first (yaw alone turned back), and the turn, rad, clockwise seen from above.
struct Excursion {
  double forward_m = 0;
  double right_m = 0;
  double down_m = 0;
  double yaw_rad = 0;
};

Excursion excursion(const VehicleMotion& from, double yaw_from_rad, const VehicleMotion& to,
                    double yaw_to_rad);

/// What came of asking for one axis.
enum class AxisVerdict {
  AsCommanded,
  NotMoved,   // less than half of what was asked for
  Opposite,   // the other way: a sign is wrong
  OtherAxis,  // mostly along another axis: the mount or the frame is wrong
};

/// "as commanded", "not moved", "opposite", "other axis".
const char* name(AxisVerdict verdict);

/// Compares what was asked for (rate, m/s or rad/s, for so long) with what was done. A vehicle lags
/// and its estimator errs: half of the way is enough to know it. Another axis counts when the
/// vehicle went further along it than along the one asked for, and at least half the way. A turn is
/// judged by the turn alone.
AxisVerdict judge(MotionAxis axis, double rate, double seconds, const Excursion& done);

/// In plain words: "commanded right 0.30 m/s for 2.0 s: the vehicle moved right 0.52 m".
std::string words(MotionAxis axis, double rate, double seconds, const Excursion& done);

}  // namespace kestrel

#pragma once

#include "kestrel/vehicle/dead_reckoning.hpp"

namespace kestrel {

/// The gain (1/s) from which on a loop that measures every period_s and whose answer is obeyed
/// latency_s after the measurement swings without end: the least of
///   2 sin(pi / (2 (2 d + 1))) / period, d = latency / period: a vehicle that follows at once;
///   w |1 + v w j - v t w^2|, where the phase w T + arg(1 + v w j - v t w^2) is a right angle:
///   forward and right, with the time constants v and t of velocity and tilt; the same of the lags
///   of vertical speed and yaw rate. T = latency + period / 2: a held command is half a period old
///   on average.
/// Within 15 % of the sampled loop with that vehicle, on the safe side where the period is long
/// against the vehicle. A camera ahead of or below the centre of tilt lowers it by its arm times
/// w^2 / g: by a tenth at 30 Hz and 0.1 m. Throws std::invalid_argument for a period that is not
/// positive, a latency that is negative, or numbers that are not finite.
double gain_limit_per_s(double period_s, double latency_s, const VelocityResponse& response);

}  // namespace kestrel

#include "kestrel/vehicle/gain_limit.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>

namespace kestrel {
namespace {

/// 1 / (transfer from command to velocity) at this frequency.
std::complex<double> inverse_response(double w_rad_s, double lag_s, double second_lag_s) {
  return {1 - lag_s * second_lag_s * w_rad_s * w_rad_s, lag_s * w_rad_s};
}

/// Gain at which an integrator behind two lags and a dead time has lost half a turn of phase: the
/// integrator's right angle, and this one. The phase rises with the frequency, so that halving
/// finds it; the bracket holds it because the dead time alone, or the two lags alone, reach it.
double crossover_gain_per_s(double dead_s, double lag_s, double second_lag_s) {
  const auto phase = [&](double w) {
    return w * dead_s + std::arg(inverse_response(w, lag_s, second_lag_s));
  };
  double low = 0;
  double high = M_PI / (2 * dead_s);
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (phase(middle) < M_PI / 2 ? low : high) = middle;
  }
  return low * std::abs(inverse_response(low, lag_s, second_lag_s));
}

}  // namespace

double gain_limit_per_s(double period_s, double latency_s, const VelocityResponse& response) {
  if (!(std::isfinite(period_s) && period_s > 0)) {
    throw std::invalid_argument("period_s: must be positive and finite");
  }
  if (!(std::isfinite(latency_s) && latency_s >= 0)) {
    throw std::invalid_argument("latency_s: must be finite and not negative");
  }
  response.check();
  const double delays = latency_s / period_s;
  const double at_once = 2 * std::sin(M_PI / (2 * (2 * delays + 1))) / period_s;
  const double dead_s = latency_s + period_s / 2;
  return std::min({at_once, crossover_gain_per_s(dead_s, response.velocity_s, response.tilt_s),
                   crossover_gain_per_s(dead_s, response.vertical_s, 0),
                   crossover_gain_per_s(dead_s, response.yaw_s, 0)});
}

}  // namespace kestrel

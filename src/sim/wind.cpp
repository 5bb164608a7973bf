#include "kestrel/sim/wind.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "random.hpp"

namespace kestrel {
namespace {

constexpr double kFeetPerMetre = 1 / 0.3048;
constexpr double kLeastSpeed_m_s = 1;  // that carries the turbulence past

const WindOptions& checked(const WindOptions& options) {
  options.check();
  return options;
}

double checked_period(double period_s) {
  if (!std::isfinite(period_s) || period_s <= 0) {
    throw std::invalid_argument("period_s: must be positive");
  }
  return period_s;
}

}  // namespace

void WindOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(mean_ned_m_s.allFinite(), "mean_ned_m_s: must be finite");
  require(std::isfinite(turbulence_m_s) && turbulence_m_s >= 0,
          "turbulence_m_s: must not be negative");
  require(altitude_m >= 3 && altitude_m <= 300, "altitude_m: must be within [3, 300]");
  require(gust_ned_m_s.allFinite(), "gust_ned_m_s: must be finite");
  require(std::isfinite(gust_start_s), "gust_start_s: must be finite");
  require(std::isfinite(gust_duration_s) && gust_duration_s > 0,
          "gust_duration_s: must be positive");
}

Turbulence turbulence(const WindOptions& options) {
  const double h_ft = options.altitude_m * kFeetPerMetre;
  const double ratio = 0.177 + 0.000823 * h_ft;
  const double vertical = 0.1 * options.turbulence_m_s;
  const double level = vertical / std::pow(ratio, 0.4);
  const double length_m = h_ft / std::pow(ratio, 1.2) / kFeetPerMetre;
  return {{level, level, vertical}, {length_m, length_m, options.altitude_m}};
}

Wind::Wind(const WindOptions& options, std::uint64_t seed, double period_s)
    : options_(checked(options)), period_s_(checked_period(period_s)), seed_(seed) {
  const double speed = options_.mean_ned_m_s.head<2>().norm();
  const double azimuth =
      speed > 0 ? std::atan2(options_.mean_ned_m_s.y(), options_.mean_ned_m_s.x()) : 0;
  const double c = std::cos(azimuth);
  const double s = std::sin(azimuth);
  ned_from_wind_ << c, -s, 0, s, c, 0, 0, 0, 1;
  const Turbulence t = turbulence(options_);
  for (int axis = 0; axis < 3; ++axis) {
    const double rate_per_s = std::max(speed, kLeastSpeed_m_s) / t.length_m[axis];
    filters_[std::size_t(axis)] = filter(t.sigma_m_s[axis], rate_per_s, period_s_, axis == 0);
  }
  // Turbulence was there before the first step: its stationary state, by letting it blow for a
  // while.
  for (auto& each : filters_) {
    const double quiet = each.decay > 0 ? -std::log(each.decay) : 1;
    for (int i = 0, n = int(std::min(20000.0, 10 / quiet)); i < n; ++i) advance(each);
  }
}

// x1' = -a x1 + n, x2' = -a x2 + x1 with white noise n of unit density. Along the wind the output
// is sigma sqrt(2 a) x1; across it sigma (sqrt(3) x1 + a (1 - sqrt(3)) x2) sqrt(a): Dryden's
// spectra with a = V / L, with variance sigma^2 each.
Wind::Filter Wind::filter(double sigma_m_s, double a, double h, bool is_longitudinal) {
  Filter f;
  f.decay = std::exp(-a * h);
  f.per_step = h;
  const double e = std::exp(-2 * a * h);
  const double q11 = (1 - e) / (2 * a);
  const double q12 = (1 - e * (1 + 2 * a * h)) / (4 * a * a);
  const double q22 = (1 - e * (1 + 2 * a * h + 2 * a * a * h * h)) / (4 * a * a * a);
  f.root11 = std::sqrt(q11);
  f.root21 = q12 / f.root11;
  f.root22 = std::sqrt(std::max(0.0, q22 - f.root21 * f.root21));
  if (is_longitudinal) {
    f.along_first = sigma_m_s * std::sqrt(2 * a);
  } else {
    f.along_first = sigma_m_s * std::sqrt(3 * a);
    f.along_second = sigma_m_s * std::sqrt(a) * a * (1 - std::sqrt(3.0));
  }
  return f;
}

double Wind::advance(Filter& f) {
  const auto noise = sim_detail::normal_pair(seed_, draw_++);
  f.second = f.decay * (f.second + f.per_step * f.first) + f.root21 * noise.first +
             f.root22 * noise.second;
  f.first = f.decay * f.first + f.root11 * noise.first;
  return f.along_first * f.first + f.along_second * f.second;
}

Eigen::Vector3d Wind::next() {
  Eigen::Vector3d wind = options_.mean_ned_m_s;
  if (options_.turbulence_m_s > 0) {
    Eigen::Vector3d stirred;
    for (int axis = 0; axis < 3; ++axis) stirred[axis] = advance(filters_[std::size_t(axis)]);
    wind += ned_from_wind_ * stirred;
  }
  const double phase =
      (double(step_) * period_s_ - options_.gust_start_s) / options_.gust_duration_s;
  if (phase > 0 && phase < 1) {
    wind += options_.gust_ned_m_s * (0.5 * (1 - std::cos(2 * M_PI * phase)));
  }
  ++step_;
  return wind;
}

}  // namespace kestrel

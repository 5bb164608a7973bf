#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace kestrel {

/// Moving air: a steady wind, turbulence after Dryden as MIL-F-8785C gives it for low altitude, and
/// one gust of the shape (1 - cos)/2.
struct WindOptions {
  Eigen::Vector3d mean_ned_m_s = Eigen::Vector3d::Zero();
  double turbulence_m_s = 0;  // wind 6 m above ground that stirs the air (W20); 0: none
  double altitude_m = 10;     // above ground: sets the turbulence's lengths
  Eigen::Vector3d gust_ned_m_s = Eigen::Vector3d::Zero();  // at its peak
  double gust_start_s = 0;
  double gust_duration_s = 2;

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// Standard deviations (m/s) and scale lengths (m) of turbulence, along the wind, across, vertical.
struct Turbulence {
  Eigen::Vector3d sigma_m_s;
  Eigen::Vector3d length_m;
};

/// MIL-F-8785C, 3.7.3.4: below 1000 ft, L_w = h, L_u = L_v = h / (0.177 + 0.000823 h)^1.2 (feet),
/// sigma_w = 0.1 W20, sigma_u = sigma_v = sigma_w / (0.177 + 0.000823 h)^0.4.
Turbulence turbulence(const WindOptions& options);

/// The wind over time at a helicopter that hovers: turbulence is carried past it by the mean wind
/// (by 1 m/s at least). The same seed and period give the same wind.
class Wind {
 public:
  /// One call of next() is period_s. Throws std::invalid_argument for options that do not check or
  /// a period that is not positive.
  Wind(const WindOptions& options, std::uint64_t seed, double period_s);

  /// Wind (NED, m/s) for the next period.
  Eigen::Vector3d next();

 private:
  /// The forming filter of one axis, in its exact discrete form.
  struct Filter {
    double decay = 0;                           // e^(-a h)
    double per_step = 0;                        // h
    double root11 = 0, root21 = 0, root22 = 0;  // of the noise's covariance
    double along_first = 0, along_second = 0;   // output
    double first = 0, second = 0;               // state
  };

  static Filter filter(double sigma_m_s, double rate_per_s, double period_s, bool is_longitudinal);
  double advance(Filter& filter);

  WindOptions options_;
  double period_s_;
  std::int64_t step_ = 0;
  std::uint64_t seed_;
  std::uint64_t draw_ = 0;
  Eigen::Matrix3d ned_from_wind_;
  std::array<Filter, 3> filters_;
};

}  // namespace kestrel

#pragma once

#include <array>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "carried_way.hpp"
#include "motion_pairs.hpp"

namespace kestrel {

/// How the vehicle follows its commands: a delay common to all axes, and lags.
struct ResponseTiming {
  double delay_s = 0;
  std::array<std::size_t, 3> lags{3, 3, 3};  // of the grid: horizontal, vertical, yaw

  std::size_t lag(std::size_t axis) const { return lags[axis < 2 ? 0 : axis - 1]; }

  /// From a command of this axis to its motion: delay and lag.
  double latency_s(std::size_t axis) const;
};

/// A fit with one timing: a gain for each axis.
struct ResponseFit {
  Eigen::Vector4d gain = Eigen::Vector4d::Zero();
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  std::vector<ImageChange> residuals;
  double residual = std::numeric_limits<double>::infinity();  // sum of squares
};

class ResponseFitter {
 public:
  ResponseFitter(const LogFile& log, std::vector<MotionPair> pairs);

  /// The least squares of the pairs with this timing.
  ResponseFit fit(const ResponseTiming& timing) const;

  /// The timing that fits best: for each delay the lags in turn, until none gets better.
  ResponseTiming best_timing() const;

 private:
  Eigen::Vector4d moved(const MotionPair& pair, const ResponseTiming& timing) const;
  double improved(ResponseTiming& timing) const;

  std::vector<MotionPair> pairs_;
  std::array<std::vector<CarriedWay>, 4> carried_;
};

}  // namespace kestrel

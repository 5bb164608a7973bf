#pragma once

#include <vector>

#include <Eigen/Core>

#include "kestrel/io/run_log.hpp"

namespace kestrel {

/// How far commands of one axis have carried, with a first-order lag behind them, on a fine grid.
class CarriedWay {
 public:
  /// Axis 0 to 3: forward, right, down, yaw; the log is not empty.
  CarriedWay(const LogFile& log, Eigen::Index axis, double lag_s);

  /// m, or rad.
  double between(double from_s, double to_s) const { return upto(to_s) - upto(from_s); }

 private:
  double upto(double time_s) const;

  double start_s_;
  std::vector<double> ways_;
};

}  // namespace kestrel

#pragma once

#include <vector>

#include <Eigen/Core>

#include "kestrel/io/run_log.hpp"
#include "kestrel/loop/task.hpp"

namespace kestrel {

using ImageChange = Eigen::Matrix<double, 8, 1>;
using ChangeJacobian = Eigen::Matrix<double, 8, 4>;

/// Two frames with the target seen between them.
struct MotionPair {
  double from_s = 0;
  double to_s = 0;
  ImageChange change;
  ChangeJacobian jacobian;  // of the error by the four velocities, L cVb S4
};

/// The pairs of a run, one after the other, a quarter of a second long or a little more.
std::vector<MotionPair> motion_pairs(const LogFile& log, const Task& task);

}  // namespace kestrel

#pragma once

#include <complex>

#include <Eigen/Eigenvalues>

/// The lateral loop of the helicopter, linear about hover, as one matrix.
namespace kestrel::test {

/// Spectral radius of the loop over one period: body offset y, velocity, roll; 300 Hz Euler steps
/// of the plant; the command, held for `period` frames, is -gain times the camera's offset
/// y - 0.1 roll (it hangs 0.1 m below) as it was `delay` frames ago.
inline double lateral_spectral_radius(double gain_per_s, int period, int delay) {
  constexpr double h = 1.0 / 300;
  constexpr double g = 9.81;
  const int size = 4 + delay;  // y, v, roll, command, then camera offsets of frames k-1 ... k-d
  Eigen::MatrixXd substep = Eigen::MatrixXd::Identity(size, size);
  Eigen::MatrixXd tilt = substep;
  tilt(2, 2) -= h / 0.15;
  tilt(2, 3) = h / 0.15 / (0.5 * g);
  tilt(2, 1) = -h / 0.15 / (0.5 * g);
  Eigen::MatrixXd speed = substep;
  speed(1, 2) = h * g;
  Eigen::MatrixXd place = substep;
  place(0, 1) = h;
  substep = place * speed * tilt;
  Eigen::RowVectorXd camera = Eigen::RowVectorXd::Zero(size);
  camera[0] = 1;
  camera[2] = -0.1;
  Eigen::MatrixXd loop = Eigen::MatrixXd::Identity(size, size);
  for (int k = 0; k < period; ++k) {
    Eigen::MatrixXd command = Eigen::MatrixXd::Identity(size, size);
    if (k == 0) {
      command.row(3) =
          delay == 0 ? Eigen::RowVectorXd(-gain_per_s * camera)
                     : Eigen::RowVectorXd(-gain_per_s * Eigen::RowVectorXd::Unit(size, size - 1));
    }
    Eigen::MatrixXd remember = Eigen::MatrixXd::Identity(size, size);
    for (int d = 0; d < delay; ++d) {
      remember.row(4 + d) =
          d == 0 ? camera : Eigen::RowVectorXd(Eigen::RowVectorXd::Unit(size, 3 + d));
    }
    loop = remember * command * loop;
    for (int i = 0; i < 10; ++i) loop = substep * loop;
  }
  return loop.eigenvalues().cwiseAbs().maxCoeff();
}

/// The gain at which the radius passes 1.
inline double lateral_gain_limit_oracle(int period, int delay) {
  double stable = 0.05;
  double unstable = 20;
  while (unstable - stable > 1e-6) {
    const double middle = (stable + unstable) / 2;
    (lateral_spectral_radius(middle, period, delay) < 1 ? stable : unstable) = middle;
  }
  return stable;
}

}  // namespace kestrel::test

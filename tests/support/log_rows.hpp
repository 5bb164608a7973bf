#pragma once

#include <cmath>
#include <limits>

#include "kestrel/io/run_log.hpp"

#include "support/random.hpp"

namespace kestrel::test {

/// A double of any size, sometimes an odd one.
inline double any_number(Random& random) {
  static constexpr double kOdd[] = {0., -0., 5e-324, 1.7976931348623157e308,
                                    std::numeric_limits<double>::infinity()};
  const int kind = random.integer(0, 20);
  return kind < 5 ? kOdd[kind] : random.normal() * std::pow(10, random.integer(-12, 12));
}

inline VelocityCommand any_command(Random& random) {
  return {any_number(random), any_number(random), any_number(random), any_number(random)};
}

/// A row of the run log with any numbers; each part is there in three of four rows.
inline LogRow any_row(Random& random, int extra_columns) {
  const auto number = [&] { return any_number(random); };
  const auto is_there = [&] { return random.integer(0, 3) > 0; };
  LogRow row;
  row.frame = random.integer(0, 1000000);
  row.stamp_s = number();
  row.status = kTrackStatuses[std::size_t(random.integer(0, int(kTrackStatuses.size()) - 1))];
  row.stage = kTrackStages[std::size_t(random.integer(0, int(kTrackStages.size()) - 1))];
  row.miss = kMisses[std::size_t(random.integer(0, int(kMisses.size()) - 1))];
  row.age_s = number();
  row.confidence = number();
  row.alike_share = number();
  row.window = {number(), number(), number(), number()};
  row.keypoints = random.integer(0, 2000);
  row.matches = random.integer(0, 500);
  row.inliers = random.integer(0, 500);
  row.trials = random.integer(0, 2000);
  if (is_there())
    row.image_from_template.emplace().H = Eigen::Matrix3d::NullaryExpr([&] { return number(); });
  if (is_there())
    for (Pixel& corner : row.corners.emplace()) corner = {number(), number()};
  if (is_there())
    for (Pixel& corner : row.predicted.emplace()) corner = {number(), number()};
  if (is_there())
    for (auto& corner : row.noise.emplace()) corner = {number(), number(), number()};
  if (is_there()) row.attitude = Attitude{number(), number(), number()};
  if (is_there())
    row.pose = LoggedPose{{number(), number(), number()},
                          {number(), number(), number()},
                          number(),
                          random.integer(0, 1) == 1};
  if (is_there()) {
    for (double& e : row.servo.emplace().error) e = number();
    row.servo->error_norm = number();
    row.servo->condition = number();
    row.servo->twist = {{number(), number(), number()}, {number(), number(), number()}};
  }
  if (is_there())
    row.decision = LoggedDecision{kCommandStates[std::size_t(random.integer(0, 4))],
                                  any_command(random), any_command(random)};
  for (int i = 0; i < extra_columns; ++i)
    row.extra.push_back(is_there() ? number() : std::numeric_limits<double>::quiet_NaN());
  return row;
}

/// The log of a made-up flight of 10 s at 25 frames/s: the corners spiral into the goal, the target
/// is lost between 3.2 s and 4.4 s; with the truth the simulator adds.
inline LogFile made_up_flight() {
  Random random("made_up_flight");
  LogFile log;
  log.extra_columns = {"north_m",        "east_m",       "down_m",           "true_roll_rad",
                       "true_pitch_rad", "true_yaw_rad", "position_error_m", "angle_error_rad"};
  for (int i = 0; i < 250; ++i) {
    const double t = i / 25.;
    const double left = std::exp(-0.5 * t);  // of the way
    LogRow row;
    row.frame = i;
    row.stamp_s = 100 + t;
    row.window = {100 * left, 80, 400, 300};
    row.keypoints = 700 + random.integer(-60, 60);
    const bool found = t < 3.2 || t > 4.4;
    row.matches = found ? 120 + random.integer(-20, 20) : random.integer(0, 9);
    row.trials = found ? random.integer(5, 30) : 2000;
    row.miss = found ? Miss::None : t < 3.8 ? Miss::FewMatches : Miss::NoConsensus;
    const double angle = 0.8 * left;
    const auto noise = [&] { return 0.3 * random.normal(); };
    if (found) {
      row.inliers = row.matches - random.integer(5, 30);
      row.image_from_template.emplace();
      const double u[] = {-100, 100, 100, -100};
      const double v[] = {-75, -75, 75, 75};
      row.corners.emplace();
      row.servo.emplace();
      for (std::size_t k = 0; k < 4; ++k) {
        const double s = 1 - 0.45 * left;
        const double du = s * (std::cos(angle) * u[k] - std::sin(angle) * v[k]) + 150 * left;
        const double dv = s * (std::sin(angle) * u[k] + std::cos(angle) * v[k]) - 60 * left;
        (*row.corners)[k] = {319.5 + du + noise(), 239.5 + dv + noise()};
        row.servo->error[2 * k] = (du - u[k] + noise()) / 600;
        row.servo->error[2 * k + 1] = (dv - v[k] + noise()) / 600;
      }
      row.servo->error_norm = std::sqrt(left * left * 0.2 + 1e-6);
      row.servo->condition = 14 + random.normal();
      row.servo->twist = {{0.5 * left, -0.2 * left, 0.8 * left},
                          {0.01 * noise(), 0.02 * noise(), -0.3 * left}};
      row.pose = LoggedPose{{0.6 * left, -0.3 * left, 1.5 + 2 * left},
                            {0.02 * noise(), 0.02 * noise(), angle},
                            0.4,
                            true};
    }
    const double rise = std::min(1., t);
    row.decision = LoggedDecision{CommandState::Servo,
                                  {2.6 * left, 0.5 * left, -0.2 * left, 0.7 * left},
                                  {rise * std::min(2., 2.6 * left), rise * 0.4 * left, -0.16 * left,
                                   rise * std::min(0.52, 0.6 * left)}};
    if (!found) {
      row.decision->wanted = {};
      row.decision->state = t < 3.3   ? CommandState::Hold
                            : t < 4.2 ? CommandState::Decay
                                      : CommandState::Hover;
      const double kept = t < 3.3 ? 1 : t < 4.2 ? std::exp(-(t - 3.3) / 0.4) : 0;
      row.decision->sent = {0.5 * kept, 0.1 * kept, -0.03 * kept, 0.12 * kept};
    }
    row.extra = {-3.5 * left,        1.2 * left * std::cos(t),
                 -1.5 - 0.4 * left,  0.05 * left * std::sin(3 * t),
                 -0.08 * left,       0.6 * left,
                 3.7 * left + 0.004, 0.6 * left + 0.002};
    log.rows.push_back(row);
  }
  return log;
}

}  // namespace kestrel::test

#include "kestrel/lab/vehicle_response.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "kestrel/lab/logged_features.hpp"
#include "kestrel/servo/interaction.hpp"

namespace kestrel {
namespace {

constexpr int kFewestPairs = 12;
constexpr double kDelayStep_s = 1.0 / 15;
constexpr double kLargestDelay_s = 2;
constexpr double kGrid_s = 1.0 / 120;
/// What vehicles need to follow a velocity: from a simulated camera to a heavy helicopter.
constexpr std::array<double, 8> kLags_s{0, 0.1, 0.2, 0.3, 0.45, 0.65, 0.9, 1.3};
constexpr double kLargestStandardError = 0.3;
constexpr double kLongestGap_s = 0.5;  // between two frames in which the target counts as seen on
/// Time between the frames of a pair: long, that the motion stands out of the noise; short, that
/// the Jacobian hardly changes.
constexpr double kPair_s = 0.25;

using Jacobian = Eigen::Matrix<double, 8, 4>;
using Error = Eigen::Matrix<double, 8, 1>;

/// Two frames with the target seen between them.
struct Pair {
  double from_s = 0;
  double to_s = 0;
  Error change;
  Jacobian jacobian;  // of the error by the four velocities, L cVb S4
};

/// How far commands of one axis have carried, with a first-order lag behind them, on a fine grid.
class Carried {
 public:
  Carried(const LogFile& log, Eigen::Index axis, double lag_s) : start_s_(log.rows[0].stamp_s) {
    double speed = 0;
    double way = 0;
    for (std::size_t i = 0; i + 1 < log.rows.size(); ++i) {
      const LogRow& row = log.rows[i];
      const double asked = row.decision ? row.decision->sent.vector()[axis] : 0;
      while (start_s_ + kGrid_s * double(ways_.size()) < log.rows[i + 1].stamp_s) {
        ways_.push_back(way);
        const double follow = lag_s > 0 ? 1 - std::exp(-kGrid_s / lag_s) : 1;
        speed += follow * (asked - speed);
        way += kGrid_s * speed;
      }
    }
    ways_.push_back(way);
  }

  double between(double from_s, double to_s) const { return upto(to_s) - upto(from_s); }

 private:
  double upto(double time_s) const {
    const double place = (time_s - start_s_) / kGrid_s;
    if (!(place > 0)) return 0;
    const auto i = std::size_t(std::min(place, double(ways_.size() - 1)));
    if (i + 1 >= ways_.size()) return ways_.back();
    return ways_[i] + (place - double(i)) * (ways_[i + 1] - ways_[i]);
  }

  double start_s_;
  std::vector<double> ways_;
};

Jacobian jacobian_of(const LogRow& row, const Task& task) {
  const Mount mount = levelled_mount(row, task);
  const auto camera_from_body = mount.inverse();
  const Matrix6d cVb = twist_matrix(camera_from_body.rotation, camera_from_body.translation);
  const Eigen::MatrixXd L = interaction_matrix(logged_levelled_features(row, task));
  Eigen::Matrix<double, 6, 4> columns;
  columns << cVb.leftCols<3>(), cVb.col(5);
  return L * columns;
}

Error error_of(const LogRow& row) { return Eigen::Map<const Error>(row.servo->error.data()); }

bool is_usable(const LogRow& row, const Task& task) {
  const std::vector<Feature> seen = logged_levelled_features(row, task);
  return !seen.empty() && is_finite(seen) &&
         std::all_of(seen.begin(), seen.end(), [](auto& f) { return f.depth_m > 1e-6; });
}

std::vector<Pair> pairs_of(const LogFile& log, const Task& task) {
  std::vector<Pair> pairs;
  const LogRow* first = nullptr;  // of the pair
  const LogRow* last = nullptr;   // seen before this one without a gap
  for (const LogRow& row : log.rows) {
    const bool usable = is_usable(row, task);
    const bool follows = last != nullptr && row.stamp_s > last->stamp_s &&
                         row.stamp_s - last->stamp_s < kLongestGap_s;
    last = usable ? &row : nullptr;
    if (!usable || !follows || first == nullptr) {
      first = last;
      continue;
    }
    if (row.stamp_s - first->stamp_s < kPair_s) continue;
    pairs.push_back({first->stamp_s, row.stamp_s, error_of(row) - error_of(*first),
                     (jacobian_of(*first, task) + jacobian_of(row, task)) / 2});
    first = &row;
  }
  return pairs;
}

/// How the vehicle follows its commands: a delay common to all axes, and lags.
struct Timing {
  double delay_s = 0;
  std::array<std::size_t, 3> lags{3, 3, 3};  // of kLags_s: horizontal, vertical, yaw

  std::size_t lag(std::size_t axis) const { return lags[axis < 2 ? 0 : axis - 1]; }
};

/// A fit with one timing.
struct Fit {
  Eigen::Vector4d gain = Eigen::Vector4d::Zero();
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  std::vector<Error> residuals;
  double residual = std::numeric_limits<double>::infinity();  // sum of squares
};

class Fitter {
 public:
  Fitter(const LogFile& log, std::vector<Pair> pairs) : pairs_(std::move(pairs)) {
    for (Eigen::Index axis = 0; axis < 4; ++axis) {
      for (const double lag_s : kLags_s) carried_[std::size_t(axis)].emplace_back(log, axis, lag_s);
    }
  }

  /// The least squares of the pairs with this timing.
  Fit fit(const Timing& timing) const {
    Fit result;
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    std::vector<Jacobian> rows;
    rows.reserve(pairs_.size());
    for (const Pair& pair : pairs_) {
      rows.emplace_back(pair.jacobian * moved(pair, timing).asDiagonal());
      result.normal += rows.back().transpose() * rows.back();
      right += rows.back().transpose() * pair.change;
    }
    // An axis never commanded would make the system singular; it gets no gain and no certainty.
    const double floor = 1e-12 * std::max(result.normal.trace(), 1e-300);
    result.normal.diagonal().array() += floor;
    result.gain = result.normal.ldlt().solve(right);
    result.residual = 0;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      result.residuals.emplace_back(pairs_[i].change - rows[i] * result.gain);
      result.residual += result.residuals.back().squaredNorm();
    }
    return result;
  }

  /// The timing that fits best: for each delay the lags in turn, until none gets better.
  Timing best_timing() const {
    Timing best;
    double least = fit(best).residual;
    for (int i = 0; i * kDelayStep_s <= kLargestDelay_s; ++i) {
      Timing timing = best;
      timing.delay_s = i * kDelayStep_s;
      const double residual = improved(timing);
      if (residual < least) {
        least = residual;
        best = timing;
      }
    }
    return best;
  }

 private:
  Eigen::Vector4d moved(const Pair& pair, const Timing& timing) const {
    Eigen::Vector4d way;
    for (Eigen::Index axis = 0; axis < 4; ++axis) {
      const Carried& carried = carried_[std::size_t(axis)][timing.lag(std::size_t(axis))];
      way[axis] = carried.between(pair.from_s - timing.delay_s, pair.to_s - timing.delay_s);
    }
    return way;
  }

  double improved(Timing& timing) const {
    double least = fit(timing).residual;
    for (bool better = true; better;) {
      better = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t lag = 0; lag < kLags_s.size(); ++lag) {
          Timing other = timing;
          other.lags[axis] = lag;
          const double residual = fit(other).residual;
          if (!(residual < least)) continue;
          least = residual;
          timing = other;
          better = true;
        }
      }
    }
    return least;
  }

  std::vector<Pair> pairs_;
  std::array<std::vector<Carried>, 4> carried_;
};

/// How many residuals in a row say the same: 1 + 2 sum of the autocorrelation until it is spent.
double dependence(const std::vector<Error>& residuals) {
  double power = 0;
  for (const Error& r : residuals) power += r.squaredNorm();
  if (!(power > 0)) return 1;
  double length = 1;
  for (std::size_t lag = 1; lag < residuals.size() / 2; ++lag) {
    double sum = 0;
    for (std::size_t i = lag; i < residuals.size(); ++i)
      sum += residuals[i].dot(residuals[i - lag]);
    if (sum < 0.05 * power) break;
    length += 2 * sum / power;
  }
  return length;
}

/// The least share of the image's motion an axis must be expected to have made to be judged.
constexpr double kLeastShare = 1e-4;

VehicleResponse response(const Fit& best, double power, int pairs) {
  VehicleResponse result;
  result.explained = std::clamp(1 - best.residual / power, 0., 1.);
  result.pairs = pairs;
  const double variance = best.residual / (8 * pairs) * dependence(best.residuals);
  const Eigen::Matrix4d covariance =
      best.normal.ldlt().solve(Eigen::Matrix4d::Identity()) * variance;
  for (Eigen::Index axis = 0; axis < 4; ++axis) {
    const double error = std::sqrt(covariance(axis, axis));
    const bool used = best.normal(axis, axis) >= kLeastShare * power;
    if (!used || !(error <= kLargestStandardError)) continue;
    result.axes[std::size_t(axis)] = AxisResponse{best.gain[axis], error, 0};
  }
  return result;
}

}  // namespace

std::optional<VehicleResponse> vehicle_response(const LogFile& log, const Task& task) {
  std::vector<Pair> pairs = pairs_of(log, task);
  if (int(pairs.size()) < kFewestPairs) return std::nullopt;
  double power = 0;
  for (const Pair& pair : pairs) power += pair.change.squaredNorm();
  if (!(power > 0)) return std::nullopt;
  const int count = int(pairs.size());
  const Fitter fitter(log, std::move(pairs));
  const Timing timing = fitter.best_timing();
  const Fit best = fitter.fit(timing);
  if (!(best.gain.allFinite() && best.normal.trace() > 1e-250)) return std::nullopt;
  VehicleResponse result = response(best, power, count);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    if (!result.axes[axis]) continue;
    result.axes[axis]->latency_s = timing.delay_s + kLags_s[timing.lag(axis)];
  }
  return result;
}

const char* axis_name(int axis) {
  static constexpr std::array<const char*, 4> kNames{"forward", "right", "down", "yaw"};
  return kNames.at(std::size_t(axis));
}

}  // namespace kestrel

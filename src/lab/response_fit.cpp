#include "response_fit.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/Cholesky>

namespace kestrel {
namespace {

constexpr double kDelayStep_s = 1.0 / 15;
constexpr double kLargestDelay_s = 2;
/// What vehicles need to follow a velocity: from a simulated camera to a heavy helicopter.
constexpr std::array<double, 8> kLags_s{0, 0.1, 0.2, 0.3, 0.45, 0.65, 0.9, 1.3};

}  // namespace

double ResponseTiming::latency_s(std::size_t axis) const { return delay_s + kLags_s[lag(axis)]; }

ResponseFitter::ResponseFitter(const LogFile& log, std::vector<MotionPair> pairs)
    : pairs_(std::move(pairs)) {
  for (Eigen::Index axis = 0; axis < 4; ++axis) {
    for (const double lag_s : kLags_s) carried_[std::size_t(axis)].emplace_back(log, axis, lag_s);
  }
}

ResponseFit ResponseFitter::fit(const ResponseTiming& timing) const {
  ResponseFit result;
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  std::vector<ChangeJacobian> rows;
  rows.reserve(pairs_.size());
  for (const MotionPair& pair : pairs_) {
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

ResponseTiming ResponseFitter::best_timing() const {
  ResponseTiming best;
  double least = fit(best).residual;
  for (int i = 0; i * kDelayStep_s <= kLargestDelay_s; ++i) {
    ResponseTiming timing = best;
    timing.delay_s = i * kDelayStep_s;
    const double residual = improved(timing);
    if (residual < least) {
      least = residual;
      best = timing;
    }
  }
  return best;
}

Eigen::Vector4d ResponseFitter::moved(const MotionPair& pair, const ResponseTiming& timing) const {
  Eigen::Vector4d way;
  for (Eigen::Index axis = 0; axis < 4; ++axis) {
    const CarriedWay& carried = carried_[std::size_t(axis)][timing.lag(std::size_t(axis))];
    way[axis] = carried.between(pair.from_s - timing.delay_s, pair.to_s - timing.delay_s);
  }
  return way;
}

double ResponseFitter::improved(ResponseTiming& timing) const {
  double least = fit(timing).residual;
  for (bool better = true; better;) {
    better = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t lag = 0; lag < kLags_s.size(); ++lag) {
        ResponseTiming other = timing;
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

}  // namespace kestrel

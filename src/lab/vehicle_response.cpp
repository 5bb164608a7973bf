#include "kestrel/lab/vehicle_response.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>

#include "response_fit.hpp"

namespace kestrel {
namespace {

constexpr int kFewestPairs = 12;
constexpr double kLargestStandardError = 0.3;

/// How many residuals in a row say the same: 1 + 2 sum of the autocorrelation until it is spent.
double dependence(const std::vector<ImageChange>& residuals) {
  double power = 0;
  for (const ImageChange& r : residuals) power += r.squaredNorm();
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

VehicleResponse response(const ResponseFit& best, double power, int pairs) {
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
  std::vector<MotionPair> pairs = motion_pairs(log, task);
  if (int(pairs.size()) < kFewestPairs) return std::nullopt;
  double power = 0;
  for (const MotionPair& pair : pairs) power += pair.change.squaredNorm();
  if (!(power > 0)) return std::nullopt;
  const int count = int(pairs.size());
  const ResponseFitter fitter(log, std::move(pairs));
  const ResponseTiming timing = fitter.best_timing();
  const ResponseFit best = fitter.fit(timing);
  if (!(best.gain.allFinite() && best.normal.trace() > 1e-250)) return std::nullopt;
  VehicleResponse result = response(best, power, count);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    if (!result.axes[axis]) continue;
    result.axes[axis]->latency_s = timing.latency_s(axis);
  }
  return result;
}

const char* axis_name(int axis) {
  static constexpr std::array<const char*, 4> kNames{"forward", "right", "down", "yaw"};
  return kNames.at(std::size_t(axis));
}

}  // namespace kestrel

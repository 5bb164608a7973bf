#include "seen_motion.hpp"

#include <cmath>

namespace kestrel {
namespace {

/// A sight farther off the prediction than this many standard deviations is another motion.
constexpr double kSurprise = 5;

/// A deviation below this is not believed: the pixels' own is a hundredth, the plane's flatness and
/// the lens are worse.
constexpr double kLeastVariancePx2 = 0.01;

bool is_surprise(const CornerMotion& ahead, const std::array<Pixel, 4>& corners,
                 const Vector8d& noise) {
  const auto expected = ahead.corners();
  for (std::size_t i = 0; i < 4; ++i) {
    const auto k = Eigen::Index(2 * i);
    const double u = ahead.coordinates[2 * i].covariance(0, 0) + noise[k];
    const double v = ahead.coordinates[2 * i + 1].covariance(0, 0) + noise[k + 1];
    if (std::abs(corners[i].u - expected[i].u) > kSurprise * std::sqrt(u)) return true;
    if (std::abs(corners[i].v - expected[i].v) > kSurprise * std::sqrt(v)) return true;
  }
  return false;
}

}  // namespace

std::optional<CornerMotion> motion_at(double stamp_s, const TrackState& state,
                                      const TrackOptions& options) {
  if (!state.motion) return std::nullopt;
  const double age_s = stamp_s - state.motion->stamp_s;
  if (!(age_s >= 0 && age_s <= options.coast_s)) return std::nullopt;
  return predicted(*state.motion, stamp_s, options.motion);
}

std::optional<Expectation> expectation(const std::optional<CornerMotion>& motion,
                                       const Template& model) {
  if (!motion) return std::nullopt;
  const auto H = homography_from_outline(motion->corners(), model.width(), model.height());
  if (!H) return std::nullopt;
  return Expectation{*H, motion->deviation_px()};
}

CornerMotion seen_motion(const std::optional<CornerMotion>& ahead,
                         const std::array<Pixel, 4>& corners, const CornerCovariance& covariance,
                         double stamp_s, const MotionOptions& options) {
  const Vector8d noise = covariance.diagonal().cwiseMax(kLeastVariancePx2);
  return ahead && !is_surprise(*ahead, corners, noise)
             ? corrected(*ahead, corners, noise)
             : first_motion(corners, noise, stamp_s, options);
}

}  // namespace kestrel

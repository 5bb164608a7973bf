#include "input_check.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "point_features.hpp"

namespace kestrel::laws {
namespace {

/// A number of a feature, of a pose or of a basis is no larger: products of such numbers stay far
/// from an overflow.
constexpr double kLargest = 1e6;
constexpr double kSmallestDepth_m = 1e-6;  // below, vpFeaturePoint throws
/// Points nearer than this to a line (as a share of their extent) are on it to rounding, of the
/// square root of the machine's precision.
constexpr double kOnALine = 1e-7;
/// A Jacobian that is singular while the points are that near to a line is so because of it.
constexpr double kNearlyOnALine = 1e-3;

using Points = std::vector<Feature>;

template <class Matrix>
bool is_sane(const Matrix& numbers) {
  return (numbers.array().abs() <= kLargest).all();  // false for NaN
}

bool is_sane(const ImagePoint& p) { return std::abs(p.x) <= kLargest && std::abs(p.y) <= kLargest; }

bool is_sane(const TargetPose& pose) { return is_sane(pose.rotation) && is_sane(pose.translation); }

bool is_sane(const Displacement& step) {
  return is_sane(step.rotation) && is_sane(step.translation);
}

template <class Value>
bool is_sane(const std::optional<Value>& value) {
  return !value || is_sane(*value);
}

/// Depths may be NaN: not known.
bool is_sane(const Points& points) {
  return std::all_of(points.begin(), points.end(), [](const Feature& f) {
    return is_sane(f.at) && !(std::abs(f.depth_m) > kLargest);
  });
}

bool is_sane(const LawInput& input) {
  return is_sane(input.measured) && is_sane(input.desired) && is_sane(input.goal_from_camera) &&
         is_sane(input.camera_from_target) && is_sane(input.goal_from_target) &&
         is_sane(input.camera_from_goal_homography) && is_sane(input.camera_motion) &&
         is_sane(input.basis) && std::isfinite(input.time_s);
}

/// Whether the law computes with the depths of the measured points.
bool uses_depths(Law law) {
  switch (law) {
    case Law::Cur:
    case Law::Mean:
    case Law::Mjp:
    case Law::PmjR:
    case Law::PmjT:
    case Law::Lm:
    case Law::Transpose:
    case Law::TransposeRaw:
    case Law::Polar:
    case Law::Partition:
      return true;
    default:
      return false;
  }
}

bool are_in_front(const Points& points) {
  return std::all_of(points.begin(), points.end(),
                     [](const Feature& f) { return f.depth_m >= kSmallestDepth_m; });
}

bool is_none_behind(const Points& points) {
  return std::none_of(points.begin(), points.end(),
                      [](const Feature& f) { return f.depth_m < kSmallestDepth_m; });
}

bool are_one(const Feature& a, const Feature& b) { return a.at.x == b.at.x && a.at.y == b.at.y; }

bool are_at_three_places(const Points& points) {
  const Feature& first = points.front();
  const auto second = std::find_if(points.begin(), points.end(),
                                   [&](const Feature& f) { return !are_one(f, first); });
  return std::any_of(second, points.end(),
                     [&](const Feature& f) { return !are_one(f, first) && !are_one(f, *second); });
}

}  // namespace

LawRefusal refusal_of(const LawInput& input, Law law) {
  if (input.measured.size() != input.desired.size()) return LawRefusal::Unequal;
  if (input.measured.size() < 3) return LawRefusal::FewPoints;
  if (!is_sane(input)) return LawRefusal::NotFinite;
  if (!are_in_front(input.desired) || !is_none_behind(input.measured)) return LawRefusal::Depth;
  if (uses_depths(law) && !are_in_front(input.measured)) return LawRefusal::Depth;
  if (!are_at_three_places(input.measured) || !are_at_three_places(input.desired)) {
    return LawRefusal::Coincident;
  }
  // Nor is a turn about the line seen, nor a pose fixed; of some laws' features there are none.
  if (on_a_line(input.desired, kOnALine) || on_a_line(input.measured, kOnALine)) {
    return LawRefusal::Collinear;
  }
  if (input.basis.cols() > 0 && input.basis.isZero(0)) return LawRefusal::Unreachable;
  return LawRefusal::None;
}

LawRefusal cause_of_singularity(const LawInput& input) {
  const bool collinear =
      on_a_line(input.measured, kNearlyOnALine) || on_a_line(input.desired, kNearlyOnALine);
  return collinear ? LawRefusal::Collinear : LawRefusal::Singular;
}

}  // namespace kestrel::laws

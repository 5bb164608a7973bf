#include "kestrel/geometry/plane_pose.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "plane_minima.hpp"

namespace kestrel {
namespace {

using minima::Solution;
using minima::View;

std::optional<View> view_of(const Homography& image_from_template, const PlaneSize& size,
                            const Camera& camera) {
  const auto pixels = outline(image_from_template, size.width_px, size.height_px);
  View view{corners_in_target(size), {}, {}};
  const Eigen::Vector3d& corner = view.corners[2];
  if (!(corner.allFinite() && corner.x() > 0 && corner.y() > 0)) return std::nullopt;
  for (std::size_t i = 0; i < 4; ++i) {
    const ImagePoint p = camera.to_image_point(pixels[i]);
    view.seen[i] = {p.x, p.y};
    view.px_per_unit[i] = camera.pixel_jacobian(p);
    if (!view.seen[i].allFinite() || !view.px_per_unit[i].allFinite()) return std::nullopt;
  }
  return view;
}

/// True when the corners turn clockwise on the screen at each of the four: a convex outline seen
/// from the front. Only then is every corner in front of the camera.
bool is_front_view(const View& view) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& b = view.seen[(i + 1) % 4];
    if (!(minima::cross(b - view.seen[i], view.seen[(i + 2) % 4] - b) > 0)) return false;
  }
  return true;
}

bool is_answer(const Solution& solution) {
  const TargetPose& pose = solution.pose;
  return std::isfinite(solution.squared_px) && pose.translation.allFinite() &&
         pose.rotation.col(2).dot(pose.translation) > 0;
}

double turn(const TargetPose& a, const TargetPose& b) {
  return rotation_vector(a.rotation.transpose() * b.rotation).norm();
}

/// Minima closer than this (rad) are one: both starts have run into it.
constexpr double kSameMinimum = 0.01;

/// Odds of 100 to 1: 2 ln 100, which is also the 99 % point of chi-square with the view's two
/// degrees of freedom (eight coordinates, six of pose).
constexpr double kDecisive = 9.21;

double square(double x) { return x * x; }
double rms_px(const Solution& solution) { return std::sqrt(solution.squared_px / 4); }

}  // namespace

void PlanePoseOptions::check() const {
  if (!(std::isfinite(corner_noise_px) && corner_noise_px >= 0)) {
    throw std::invalid_argument("corner_noise_px: must be finite and not negative");
  }
}

std::array<Eigen::Vector3d, 4> corners_in_target(const PlaneSize& size) {
  const double x = size.width_m * (size.width_px - 1) / size.width_px / 2;
  const double y = size.height_m * (size.height_px - 1) / size.height_px / 2;
  return {{{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}};
}

std::optional<PlanePose> plane_pose(const Homography& image_from_template, const PlaneSize& size,
                                    const Camera& camera, const std::optional<TargetPose>& previous,
                                    const PlanePoseOptions& options) {
  const auto view = view_of(image_from_template, size, camera);
  if (!view || !is_front_view(*view)) return std::nullopt;
  const auto starts = minima::starts(minima::first_order(*view));
  Solution best = minima::refined(*view, starts[0]);
  Solution other = minima::refined(*view, starts[1]);
  if (other.squared_px < best.squared_px) std::swap(best, other);
  if (!is_answer(best)) return std::nullopt;
  if (!is_answer(other) || turn(best.pose, other.pose) < kSameMinimum) {
    return PlanePose{best.pose, rms_px(best), std::nullopt, 0, false};
  }
  // Twice the logarithm of the likelihood ratio of the two, for normal noise at the corners.
  const double evidence = (other.squared_px - best.squared_px) / square(options.corner_noise_px);
  const bool ambiguous = !(evidence > kDecisive);
  if (ambiguous && previous && turn(other.pose, *previous) < turn(best.pose, *previous)) {
    std::swap(best, other);
  }
  return PlanePose{best.pose, rms_px(best), other.pose, rms_px(other), ambiguous};
}

}  // namespace kestrel

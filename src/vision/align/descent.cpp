#include "descent.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/LU>

#include "warp_reach.hpp"

namespace kestrel {
namespace {

/// A step larger than this, in coordinates of warp(), leaves the range of its linearisation.
constexpr double kLargestStep = 0.3;

/// Damping after the first step that fails, which halves a step, and its factor after the next
/// ones.
constexpr double kDamped = 1;
constexpr double kMoreDamping = 3;

/// Fewer blocks than this cannot hold all eight parameters.
constexpr int kBlocksForHomography = 6;

/// A place, and what the image shows there.
struct Place {
  Homography at;
  Normal seen;
};

/// The motion of the template that would explain what the image shows, shortened by the damping;
/// empty when that does not determine one.
std::optional<Vector8d> step(Normal n, double damping, const Eigen::Matrix3d& scaled,
                             const TemplateBlocks& all) {
  n.information.diagonal() *= 1 + damping;
  auto parameters = solved(n, n.blocks >= kBlocksForHomography ? 8 : n.blocks >= 2 ? 4 : 2);
  if (!parameters) return std::nullopt;
  const double far = std::max(reach(warp(*parameters), scaled, all), parameters->norm());
  if (far > kLargestStep) *parameters *= kLargestStep / far;
  return parameters;
}

/// How far a step moves the texture that takes part, root mean square, in coordinates of warp():
/// corners that nothing is seen of do not count.
double moved(const Vector8d& parameters, const Normal& n) {
  const double of_a_shift = (n.information(0, 0) + n.information(1, 1)) / 2;
  return std::sqrt(parameters.dot(n.information * parameters) / of_a_shift);
}

Homography stepped(const Homography& from, const Eigen::Matrix3d& W, const Eigen::Matrix3d& scaled,
                   const Eigen::Matrix3d& from_scaled) {
  Homography next;
  next.H = from.H * (from_scaled * W.inverse() * scaled);
  next.H /= next.H(2, 2);
  return next;
}

}  // namespace

Descended descend(BlockLook& look, const ImagePyramid& image, const LevelPair& at,
                  const DescentStart& start, const DescentBounds& bounds,
                  const Eigen::Matrix3d& scaled) {
  const Eigen::Matrix3d from_scaled = scaled.inverse();
  int looks = 0;
  const auto place = [&](const Homography& H) { return Place{H, look.measured(image, at, H)}; };
  Place now = place(start.led);
  ++looks;
  if (start.led.H != start.first.H) {
    const Place first = place(start.first);
    if (first.seen.shown > now.seen.shown) now = first;
  }
  Place best = now;
  double damping = 0;
  for (int i = 0; i < bounds.steps; ++i) {
    const auto parameters = step(now.seen, damping, scaled, look.blocks());
    if (!parameters) break;
    const Eigen::Matrix3d W = warp(*parameters);
    const Homography H = stepped(now.at, W, scaled, from_scaled);
    if (reach(W, scaled, look.blocks()) < bounds.tolerance) return {H, looks};
    const Place next = place(H);
    ++looks;
    const bool is_less = next.seen.shown < now.seen.shown;
    if (is_less && moved(*parameters, now.seen) > bounds.range) {
      damping = std::max(kDamped, damping * kMoreDamping);
      continue;
    }
    damping = damping > kDamped ? damping / kMoreDamping : 0;
    now = next;
    if (now.seen.shown >= best.seen.shown) best = now;
  }
  return {best.at, looks};
}

}  // namespace kestrel

#include "bench/stress_view.hpp"

#include <algorithm>
#include <cmath>

#include "bench/stress_light.hpp"

namespace kestrel::test {
namespace {

constexpr int kMostSubframes = 32;
constexpr double kBetweenSubframes_px = 0.7;

Corners corners_at(const StressView& view, double t_frames) {
  return outline(image_from_template(view, t_frames), view.template_px.width,
                 view.template_px.height);
}

}  // namespace

Homography image_from_template(const StressView& view, double t_frames) {
  const TargetPose pose = view.motion.at(t_frames).camera_from_target();
  Eigen::Matrix3d K;
  K << kFocal_px, 0, 319.5, 0, kFocal_px, 239.5, 0, 0, 1;
  Eigen::Matrix3d ray_from_plane;
  ray_from_plane << pose.rotation.leftCols<2>(), pose.translation;
  Eigen::Matrix3d plane_from_template;
  plane_from_template << 1, 0, -(view.template_px.width - 1) / 2., 0, 1,
      -(view.template_px.height - 1) / 2., 0, 0, kPxPerMetre;
  return {K * ray_from_plane * plane_from_template};
}

std::vector<double> instants(const StressView& view, std::int64_t frame) {
  const double open = frame == 0 ? 0 : stress_exposure(view.cls);
  if (open == 0) return {double(frame)};
  constexpr int kSteps = 8;
  double path_px = 0;
  Corners before = corners_at(view, double(frame) - open / 2);
  for (int i = 1; i <= kSteps; ++i) {
    const Corners now = corners_at(view, double(frame) + open * (double(i) / kSteps - 0.5));
    double longest = 0;
    for (std::size_t c = 0; c < 4; ++c) longest = std::max(longest, distance(before[c], now[c]));
    path_px += longest;
    before = now;
  }
  const int n = std::clamp(int(std::ceil(path_px / kBetweenSubframes_px)), 2, kMostSubframes);
  std::vector<double> result;
  result.reserve(std::size_t(n));
  for (int i = 0; i < n; ++i) result.push_back(double(frame) + open * ((i + 0.5) / n - 0.5));
  return result;
}

Corners corners_seen(const StressView& view, std::int64_t frame) {
  const std::vector<double> times = instants(view, frame);
  Corners sum{};
  for (const double t : times) {
    const Corners at = corners_at(view, t);
    for (std::size_t c = 0; c < 4; ++c) {
      sum[c].u += at[c].u / double(times.size());
      sum[c].v += at[c].v / double(times.size());
    }
  }
  return sum;
}

double visible_share(const StressView& view, double t_frames) {
  const Homography H = image_from_template(view, t_frames);
  constexpr int kGrid = 20;
  int inside = 0;
  for (int i = 0; i < kGrid * kGrid; ++i) {
    const int row = i / kGrid;
    const Pixel p = H * Pixel{(i % kGrid + 0.5) / kGrid * view.template_px.width - 0.5,
                              (row + 0.5) / kGrid * view.template_px.height - 0.5};
    inside += p.u > 0 && p.v > 0 && p.u < 639 && p.v < 479 ? 1 : 0;
  }
  return inside / double(kGrid * kGrid);
}

}  // namespace kestrel::test

#include "kestrel/io/mount_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "kestrel/io/svg_space.hpp"

#include "svg_parts.hpp"

namespace kestrel {
namespace {

using Eigen::Vector3d;

constexpr double kWidth_px = 560;
constexpr double kHeight_px = 300;

/// From the right side, the nose to the right; from above, the nose up.
const SpaceView kSide{{0, 0, -1}, {0, 1, 0}};
const SpaceView kTop{{1, 0, 0}, {0, 0, -1}};

/// Directions of the image's corners in the camera, z = 1, in order around it; a lens that sees no
/// plane z = 1 there is drawn as far as it does.
std::array<Vector3d, 4> corner_rays(const std::optional<Camera>& camera) {
  const double x = std::tan(M_PI / 6);
  const double y = std::tan(M_PI / 8);
  std::array<Vector3d, 4> rays = {{{-x, -y, 1}, {x, -y, 1}, {x, y, 1}, {-x, y, 1}}};
  if (!camera || camera->parameters().width <= 0 || camera->parameters().height <= 0) return rays;
  const CameraParameters& p = camera->parameters();
  const double right = p.width - 0.5;
  const double bottom = p.height - 0.5;
  const std::array<Pixel, 4> corners = {
      {{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}}};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    for (int tenths = 10; tenths > 0; --tenths) {
      const double share = tenths / 10.0;
      const ImagePoint at = camera->to_image_point(
          {p.u0 + share * (corners[i].u - p.u0), p.v0 + share * (corners[i].v - p.v0)});
      if (!std::isfinite(at.x) || !std::isfinite(at.y)) continue;
      rays[i] = {at.x, at.y, 1};
      break;
    }
  }
  return rays;
}

/// The pyramid that the camera sees, length_m along its longest edge.
std::vector<SpaceLine> field_of_view(const Mount& mount, const std::optional<Camera>& camera,
                                     double length_m) {
  std::array<Vector3d, 4> ends;
  const std::array<Vector3d, 4> rays = corner_rays(camera);
  double longest = 0;
  for (const Vector3d& ray : rays) longest = std::max(longest, ray.norm());
  for (std::size_t i = 0; i < rays.size(); ++i) ends[i] = mount * (rays[i] * length_m / longest);
  const bool is_known = camera && camera->parameters().width > 0;
  SpaceLine first{is_known ? "field of view" : "field of view (unknown, 60 x 45 degrees)",
                  {ends[0], ends[1], ends[2], ends[3], ends[0]},
                  0};
  std::vector<SpaceLine> lines{first};
  for (const Vector3d& end : ends) lines.push_back({"", {mount.translation, end}, 0});
  lines.push_back({"image's upper edge", {ends[0], ends[1]}, 1});
  return lines;
}

/// The outline of some helicopter about the reference point, 1 m from nose to mast or as large as
/// the mount asks for: fuselage, boom and fin from the side; the rotor from above.
std::vector<SpaceLine> helicopter(double size_m) {
  const double s = size_m;
  const auto at = [s](double x, double y, double z) { return Vector3d(s * x, s * y, s * z); };
  SpaceLine body{"helicopter (outline)", {}, 6, Stroke::Faint};
  for (int i = 0; i <= 40; ++i) {
    const double a = 2 * M_PI * i / 40;
    body.points_m.push_back(at(0.45 * std::cos(a), 0.18 * std::sin(a), 0.2 * std::sin(a)));
  }
  SpaceLine rotor{"", {}, 6, Stroke::Faint};
  for (int i = 0; i <= 60; ++i) {
    const double a = 2 * M_PI * i / 60;
    rotor.points_m.push_back(at(0.9 * std::cos(a), 0.9 * std::sin(a), -0.4));
  }
  const SpaceLine mast{"", {at(0, 0, -0.2), at(0, 0, -0.4)}, 6, Stroke::Faint};
  const SpaceLine boom{
      "", {at(-0.45, 0, 0), at(-1.1, 0, -0.08), at(-1.2, 0, -0.3)}, 6, Stroke::Faint};
  return {body, rotor, mast, boom};
}

std::string view(const char* title, const SpaceView& from, const Mount& mount,
                 const std::optional<Camera>& camera) {
  const double size_m = std::max(0.6, 1.5 * mount.translation.norm());
  SpacePlot plot;
  plot.title = title;
  plot.lines = helicopter(size_m);
  for (SpaceLine& line : field_of_view(mount, camera, 1.2 * size_m))
    plot.lines.push_back(std::move(line));
  plot.frames = {{"body", Vector3d::Zero(), Eigen::Matrix3d::Identity()},
                 {"camera", mount.translation, mount.rotation}};
  plot.view = from;
  plot.width_px = kWidth_px;
  plot.height_px = kHeight_px;
  return svg_space(plot);
}

}  // namespace

std::string mount_picture(const Mount& body_from_camera, const std::optional<Camera>& camera) {
  const std::string side =
      view("From its right side: x forward, z down", kSide, body_from_camera, camera);
  const std::string top = view("From above: x forward, y right", kTop, body_from_camera, camera);
  return svg::document(
      kWidth_px, 2 * kHeight_px, "How the camera is mounted",
      side + fmt::format("<g transform=\"translate(0 {:g})\">{}</g>\n", kHeight_px, top));
}

}  // namespace kestrel

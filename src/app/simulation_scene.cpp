#include "simulation_scene.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kestrel/io/gray_image.hpp"
#include "kestrel/sim/texture.hpp"

namespace kestrel::app {
namespace {

constexpr double kPosterPxPerM = 400;  // finer than a 600 px camera sees from 1.5 m

Eigen::Vector3d vector(const Section& section, const std::string& key, const Eigen::Vector3d& v) {
  if (!section.has(key)) return v;
  const auto n = section.numbers(key, 3);
  return {n[0], n[1], n[2]};
}

PlaneMotion read_motion(const Section& section) {
  PlaneMotion m;
  m.velocity_m_s = vector(section, "velocity_ned_m_s", m.velocity_m_s);
  m.start_s = section.number("start_s", m.start_s);
  m.stop_s = section.number("stop_s", m.stop_s);
  m.sway_m = vector(section, "sway_ned_m", m.sway_m);
  m.sway_period_s = section.number("sway_period_s", m.sway_period_s);
  m.from_s = section.number("from_s", m.from_s);
  m.until_s = section.number("until_s", m.until_s);
  try {
    m.check();
  } catch (const std::invalid_argument& error) {
    section.fail("", error.what());
  }
  return m;
}

ThingOptions read_thing(const Section& section) {
  ThingOptions t;
  if (section.has("picture")) t.picture = section.path("picture");
  t.grey = section.number("grey", t.grey);
  if (!(t.grey >= 0 && t.grey <= 255)) section.fail("grey", "must be within 0..255");
  const auto size = section.numbers("size_m", 2);
  t.width_m = size[0];
  t.height_m = size[1];
  if (!(t.width_m > 0 && t.height_m > 0)) section.fail("size_m", "must be positive");
  t.position_ned_m = vector(section, "position_ned_m", t.position_ned_m);
  t.opacity = section.number("opacity", t.opacity);
  if (!(t.opacity > 0 && t.opacity <= 1)) section.fail("opacity", "must be within (0, 1]");
  t.motion = read_motion(section);
  return t;
}

TexturedPlane plane_of(const ThingOptions& thing) {
  TexturedPlane plane;
  plane.texture = thing.picture.empty() ? cv::Mat(16, 16, CV_8U, cv::Scalar(thing.grey))
                                        : load_gray(thing.picture);
  plane.width_m = thing.width_m;
  plane.height_m = thing.height_m;
  plane.world_from_target = world_from_wall();
  plane.world_from_target.translation = thing.position_ned_m;
  plane.opacity = thing.opacity;
  plane.motion = thing.motion;
  return plane;
}

/// The picture of the wall where the target is: the target is then no other than what is around it.
cv::Mat cut_from_wall(const Scene& scene, double width_m, double height_m) {
  const TexturedPlane& wall = scene.planes.at(1);
  const double px_per_m = wall.texture.cols / wall.width_m;
  const Eigen::Vector3d centre = wall.world_from_target.inverse() * Eigen::Vector3d::Zero();
  const auto first = [&](double at_m, double size_m, int texels) {
    return int(std::lround((at_m - size_m / 2) * px_per_m + texels / 2.0));
  };
  const cv::Rect part(first(centre.x(), width_m, wall.texture.cols),
                      first(centre.y(), height_m, wall.texture.rows),
                      int(std::lround(width_m * px_per_m)), int(std::lround(height_m * px_per_m)));
  const cv::Rect whole(cv::Point(), wall.texture.size());
  if ((part & whole) != part) throw std::invalid_argument("the target is larger than the wall");
  return wall.texture(part).clone();
}

}  // namespace

SceneOptions read_scene(const Section& simulation) {
  SceneOptions s;
  s.surface = simulation.choice<Surface>(
      "surface", {{"poster", Surface::Poster}, {"wall", Surface::Wall}}, s.surface);
  s.place = simulation.choice<Place>("target_on",
                                     {{"wall", Place::Wall}, {"ground", Place::Ground}}, s.place);
  if (s.place == Place::Ground && s.surface == Surface::Wall) {
    simulation.fail("surface", "`wall` goes with `target_on: wall`");
  }
  if (simulation.has("texture")) {
    if (s.surface == Surface::Wall) simulation.fail("texture", "goes with `surface: poster`");
    s.texture = simulation.path("texture");
  }
  if (const auto motion = simulation.child_if("target_motion")) {
    if (s.surface == Surface::Wall) simulation.fail("target_motion", "a wall does not move");
    s.target_motion = read_motion(*motion);
  }
  if (simulation.has("things")) {
    for (const SectionItem& item : simulation.items("things")) {
      if (!item.keys) simulation.fail("things", "must be a list of maps");
      s.things.push_back(read_thing(*item.keys));
    }
  }
  return s;
}

Scene scene_of(SceneOptions options, double target_width_m, double target_height_m) {
  WallOptions& wall = options.wall;
  wall.poster_width_m = target_width_m;
  wall.poster_height_m = target_height_m;
  if (options.surface == Surface::Wall) {  // one of the facade's windows to the target's centre
    wall.wall_width_m = 27;
    wall.ground_below_m = 4.8;
  }
  cv::Mat picture;
  if (!options.texture.empty()) {
    picture = load_gray(options.texture);
  } else {
    picture = poster(std::max(16, int(target_width_m * kPosterPxPerM)),
                     std::max(16, int(target_height_m * kPosterPxPerM)), wall.seed);
  }
  Scene scene = wall_scene(picture, wall);
  if (options.surface == Surface::Wall) {
    scene.planes.back().texture = cut_from_wall(scene, target_width_m, target_height_m);
  }
  scene.planes.back().motion = options.target_motion;
  if (options.place == Place::Ground) {
    scene.planes.back().world_from_target = scene.planes.front().world_from_target;
    // The ground's own axes: x east, y south, z down.
  }
  scene.target = scene.planes.size() - 1;
  for (const ThingOptions& thing : options.things) scene.planes.push_back(plane_of(thing));
  scene.check();
  return scene;
}

}  // namespace kestrel::app

#pragma once

#include <filesystem>
#include <vector>

#include "kestrel/io/yaml_section.hpp"
#include "kestrel/sim/scene.hpp"

namespace kestrel::app {

/// A rectangle beside, before or behind the target: a distractor, an occluder, or, black and not
/// opaque, a shadow.
struct ThingOptions {
  std::filesystem::path picture;  // empty: one grey level
  double grey = 60;
  double width_m = 1;
  double height_m = 1;
  Eigen::Vector3d position_ned_m = Eigen::Vector3d::Zero();  // it faces south
  double opacity = 1;
  PlaneMotion motion{};
};

/// What the target is painted on.
enum class Surface {
  Poster,  // a picture of its own
  Wall,    // a part of the facade, as the facade is there
};

/// Which way the target faces.
enum class Place {
  Wall,    // south, at the origin of the world
  Ground,  // up, 15 m south of the wall, its upper edge to the north
};

/// What a simulated camera sees.
struct SceneOptions {
  WallOptions wall;
  Surface surface = Surface::Poster;
  Place place = Place::Wall;
  std::filesystem::path texture;  // of the poster; empty: the built-in one
  PlaneMotion target_motion{};
  std::vector<ThingOptions> things;  // back to front; all before the target
};

/// The keys of the section `simulation` that say what there is to see. Throws FileError.
SceneOptions read_scene(const Section& simulation);

/// The scene with a target of this size. Throws what loading a picture throws.
Scene scene_of(SceneOptions options, double target_width_m, double target_height_m);

}  // namespace kestrel::app

#include "bench/stress_scene.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "kestrel/sim/texture.hpp"
#include "kestrel/sim/world.hpp"

#include "bench/stress_motion.hpp"

namespace kestrel::test {
namespace {

constexpr int kWallWidth_px = 1800;  // 9 m: a camera 6 m away sees 6.4 m
constexpr int kWallHeight_px = 1400;
constexpr double kFacadePxPerMetre = 66;  // windows of 59 x 106 px every 198 x 211 px
constexpr std::uint64_t kFacadeSeed = 11;

bool is_flight(const std::string& cls) {
  return cls == "flight" || cls == "flight_window" || cls == "gust";
}

TexturedPlane plane(const cv::Mat& texture, double width_m, double height_m) {
  TexturedPlane result{texture, width_m, height_m, {}};
  result.world_from_target.rotation.setIdentity();  // the world is the poster's frame here
  return result;
}

/// The picture at most 800 px wide, mirrored on all sides until it covers the wall.
cv::Mat photo_wall(const std::string& file) {
  cv::Mat photo = load_picture(file);
  if (photo.cols > 800) {
    const double shrink = 800. / photo.cols;
    cv::resize(photo, photo, {}, shrink, shrink, cv::INTER_AREA);
  }
  const int u = std::max(0, (kWallWidth_px - photo.cols + 1) / 2);
  const int v = std::max(0, (kWallHeight_px - photo.rows + 1) / 2);
  cv::Mat wall;
  cv::copyMakeBorder(photo, wall, v, v, u, u, cv::BORDER_REFLECT);
  return wall;
}

TexturedPlane wall_plane(const std::string& cls, const StressTexture& texture) {
  const cv::Mat picture =
      is_flight(cls) ? facade(kWallWidth_px, kWallHeight_px, kFacadePxPerMetre, kFacadeSeed)
                     : photo_wall(texture.wall_file);
  TexturedPlane wall = plane(picture, picture.cols / kPxPerMetre, picture.rows / kPxPerMetre);
  if (is_flight(cls)) {  // the middle of a window of the fifth column, third row, at the centre
    const double u = (1.05 + 4 * 3.0 + 0.45) * kFacadePxPerMetre;
    const double v = (0.8 + 3 * 3.2 + 0.8) * kFacadePxPerMetre;
    wall.world_from_target.translation << (picture.cols / 2. - u) / kPxPerMetre,
        (picture.rows / 2. - v) / kPxPerMetre, 0;
  }
  return wall;
}

Scene scene_of(const std::vector<TexturedPlane>& planes, double background_grey) {
  Scene scene;
  scene.planes = planes;
  scene.background_grey = background_grey;
  return scene;
}

/// The wall, with the poster unless the template is part of the facade itself.
Scene poster_scene(const std::string& cls, const StressTexture& texture, const std::string& file,
                   cv::Size px) {
  std::vector<TexturedPlane> planes{wall_plane(cls, texture)};
  if (cls != "flight_window") {
    planes.push_back(plane(load_picture(file), px.width / kPxPerMetre, px.height / kPxPerMetre));
  }
  return scene_of(planes, 110);
}

/// The next texture of the same set: dev pictures stay among themselves.
std::string other_file(const StressTexture& texture) {
  const std::vector<std::string> names = texture_names(texture.set);
  const auto at = std::find(names.begin(), names.end(), texture.name);
  const auto next = std::size_t(at - names.begin() + 1) % names.size();
  return stress_texture(names[next]).file;
}

cv::Mat occluder_picture(const StressTexture& texture) {
  const cv::Mat photo = load_picture(texture.wall_file);
  const int side = std::min({photo.cols, photo.rows, 300});
  return photo(cv::Rect((photo.cols - side) / 2, (photo.rows - side) / 2, side, side)).clone();
}

Renderer occluder_renderer(const cv::Mat& picture, double side_m) {
  return {scene_of({plane(picture, side_m, side_m)}, 0), default_camera()};
}

cv::Mat light_of(const Renderer& renderer, const TargetPose& camera_from_target) {
  const TargetPose& pose = camera_from_target;
  const Transform<frame::World, frame::Camera> world_from_camera{
      pose.rotation.transpose(), -(pose.rotation.transpose() * pose.translation)};
  cv::Mat light;
  renderer.view(world_from_camera).convertTo(light, CV_32F);
  return light;
}

}  // namespace

cv::Size poster_size(const std::string& cls, cv::Size picture) {
  if (cls == "small") return {60, 46};
  if (cls == "flight_window") return {160, 170};
  const double area_px2 = cls == "gust" ? 12000 : 32000;
  const double shape = std::clamp(double(picture.width) / picture.height, 2. / 3, 1.5);
  return {2 * int(std::lround(std::sqrt(area_px2 * shape) / 2)),
          2 * int(std::lround(std::sqrt(area_px2 / shape) / 2))};
}

double occluder_side_m(cv::Size poster_px) {
  return std::sqrt(0.4 * poster_px.area()) / kPxPerMetre;
}

StressScene::StressScene(const std::string& cls, const StressTexture& texture, cv::Size poster_px)
    : poster_(poster_scene(cls, texture, texture.file, poster_px), default_camera()),
      wall_(scene_of({wall_plane(cls, texture)}, 110), default_camera()),
      other_(poster_scene(cls, texture, other_file(texture), poster_px), default_camera()),
      occluder_(occluder_renderer(occluder_picture(texture), occluder_side_m(poster_px))),
      mask_(
          occluder_renderer(cv::Mat(16, 16, CV_8U, cv::Scalar(255)), occluder_side_m(poster_px))) {}

cv::Mat StressScene::view(const TargetPose& camera_from_target, Shown shown) const {
  if (shown == Shown::Wall) return light_of(wall_, camera_from_target);
  return light_of(shown == Shown::Poster ? poster_ : other_, camera_from_target);
}

void StressScene::occlude(cv::Mat& light, const TargetPose& camera_from_occluder) const {
  const cv::Mat mask = light_of(mask_, camera_from_occluder);
  cv::multiply(light, 255 - mask, light, 1 / 255.);
  light += light_of(occluder_, camera_from_occluder);
}

}  // namespace kestrel::test

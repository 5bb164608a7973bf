#include "kestrel/io/mount_writer.hpp"

#include "kestrel/io/csv.hpp"
#include "kestrel/io/mount_file.hpp"

namespace kestrel {
namespace {

std::string row(double a, double b, double c) {
  return '[' + number(a) + ", " + number(b) + ", " + number(c) + ']';
}

}  // namespace

std::string mount_yaml(const Mount& body_from_camera, const std::vector<std::string>& comment) {
  const Eigen::Matrix3d& R = body_from_camera.rotation;
  const Eigen::Vector3d& t = body_from_camera.translation;
  std::string text;
  for (const std::string& line : comment) text += "# " + line + '\n';
  text += "# Where the camera is: " + describe(body_from_camera) + ".\n";
  text +=
      "# Columns of rotation: the camera's axes (x image right, y image down, z into the scene) ";
  text += "in the\n# helicopter (x forward, y right, z down).\n";
  text += "translation_m: " + row(t.x(), t.y(), t.z()) + '\n';
  text += "rotation:\n";
  for (int i = 0; i < 3; ++i) text += "  - " + row(R(i, 0), R(i, 1), R(i, 2)) + '\n';
  return text;
}

}  // namespace kestrel

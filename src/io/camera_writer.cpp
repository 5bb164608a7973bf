#include "kestrel/io/camera_writer.hpp"

#include <fmt/format.h>

#include "kestrel/geometry/nearest_visp_camera.hpp"
#include "kestrel/io/csv.hpp"
#include "kestrel/io/markup.hpp"

namespace kestrel {
namespace {

std::string element(const char* name, const std::string& text) {
  return fmt::format("<{0}>{1}</{0}>\n", name, text);
}

std::string element(const char* name, double value) { return element(name, number(value)); }

std::string pinhole_elements(const CameraParameters& p) {
  return element("px", p.px) + element("py", p.py) + element("u0", p.u0) + element("v0", p.v0);
}

/// ViSP's <model>.
std::string visp_model(const CameraParameters& p) {
  const auto& d = p.distortion;
  const bool straight = p.lens == Lens::Pinhole;
  const bool fisheye = p.lens == Lens::KannalaBrandt;
  std::string text = element("type", straight  ? "perspectiveProjWithoutDistortion"
                                     : fisheye ? "ProjWithKannalaBrandtDistortion"
                                               : "perspectiveProjWithDistortion");
  text += pinhole_elements(p);
  if (p.lens == Lens::VispRadial) text += element("kud", d[0]) + element("kdu", d[1]);
  if (fisheye) {
    text += element("k1", d[0]) + element("k2", d[1]) + element("k3", d[2]) + element("k4", d[3]) +
            element("k5", 0.0);
  }
  return "<model>\n" + text + "</model>\n";
}

std::string plumb_bob(const CameraParameters& p) {
  const auto& [k1, k2, p1, p2, k3] = p.distortion;
  return "<additional_information>\n<plumb_bob>\n" + pinhole_elements(p) + element("k1", k1) +
         element("k2", k2) + element("p1", p1) + element("p2", p2) + element("k3", k3) +
         "</plumb_bob>\n</additional_information>\n";
}

/// Coefficients as OpenCV orders them.
std::vector<double> opencv_coefficients(const CameraParameters& p) {
  const auto& d = p.distortion;
  switch (p.lens) {
    case Lens::Pinhole:
      break;
    case Lens::VispRadial:
      return {d[0], 0, 0, 0, 0};
    case Lens::PlumbBob:
      return {d.begin(), d.end()};
    case Lens::KannalaBrandt:
      return {d[0], d[1], d[2], d[3]};
  }
  return {0, 0, 0, 0, 0};
}

std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + number(value);
  return "[" + text + "]";
}

std::vector<double> matrix(const CameraParameters& p) {
  return {p.px, 0, p.u0, 0, p.py, p.v0, 0, 0, 1};
}

std::string opencv_matrix(const char* key, std::size_t rows, std::size_t columns,
                          const std::vector<double>& values) {
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: {}\n", key,
                     rows, columns, list(values));
}

std::string ros_matrix(const char* key, std::size_t rows, std::size_t columns,
                       const std::vector<double>& values) {
  return fmt::format("{}:\n  rows: {}\n  cols: {}\n  data: {}\n", key, rows, columns, list(values));
}

/// The size of the image; a camera that does not know it states none.
std::string size_lines(const CameraParameters& p) {
  return p.width == 0 || p.height == 0
             ? ""
             : fmt::format("image_width: {}\nimage_height: {}\n", p.width, p.height);
}

/// A word as YAML in quotes.
std::string quoted(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) text += c;
  }
  return '"' + text + '"';
}

}  // namespace

std::string visp_xml(const Camera& camera, const std::string& name) {
  const CameraParameters& p = camera.parameters();
  const NearestVispCamera nearest = nearest_visp_camera(camera);
  std::string text = "<?xml version=\"1.0\"?>\n<root>\n";
  if (p.lens == Lens::PlumbBob) {
    text += fmt::format(
        "<!-- The calibrated lens, OpenCV's plumb bob, is below <additional_information>. <model> "
        "is\n     the nearest that ViSP has: up to {:.2f} px off. -->\n",
        nearest.largest_px);
  }
  text += "<camera>\n" + element("name", escaped(name));
  if (p.width > 0 && p.height > 0) {
    text += element("image_width", std::to_string(p.width)) +
            element("image_height", std::to_string(p.height));
  }
  text += visp_model(nearest.parameters);
  if (p.lens == Lens::PlumbBob) text += plumb_bob(p);
  return text + "</camera>\n</root>\n";
}

std::string opencv_yaml(const Camera& camera) {
  const CameraParameters& p = camera.parameters();
  const std::vector<double> lens = opencv_coefficients(p);
  std::string text = "%YAML:1.0\n---\n" + size_lines(p);
  if (p.lens == Lens::KannalaBrandt) text += "fisheye_model: 1\n";
  return text + opencv_matrix("camera_matrix", 3, 3, matrix(p)) +
         opencv_matrix("distortion_coefficients", lens.size(), 1, lens);
}

std::string ros_yaml(const Camera& camera, const std::string& name) {
  const CameraParameters& p = camera.parameters();
  const std::vector<double> lens = opencv_coefficients(p);
  return size_lines(p) + "camera_name: " + quoted(name) + "\n" +
         ros_matrix("camera_matrix", 3, 3, matrix(p)) +
         "distortion_model: " + (p.lens == Lens::KannalaBrandt ? "equidistant" : "plumb_bob") +
         "\n" + ros_matrix("distortion_coefficients", 1, lens.size(), lens) +
         ros_matrix("rectification_matrix", 3, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         ros_matrix("projection_matrix", 3, 4, {p.px, 0, p.u0, 0, 0, p.py, p.v0, 0, 0, 0, 1, 0});
}

void write_camera_files(const std::filesystem::path& folder, const Camera& camera,
                        const std::string& name) {
  write_text(folder / "camera.xml", visp_xml(camera, name));
  write_text(folder / "camera_opencv.yaml", opencv_yaml(camera));
  write_text(folder / "camera_ros.yaml", ros_yaml(camera, name));
}

}  // namespace kestrel

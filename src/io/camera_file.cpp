#include "kestrel/io/camera_file.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "kestrel/io/yaml_section.hpp"

#include "xml_file.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

/// Camera's constructor with its complaint turned into one about the file.
Camera camera_of(const CameraParameters& parameters, const fs::path& file, int line) {
  try {
    return Camera(parameters);
  } catch (const std::invalid_argument& error) {
    throw FileError(file, line, "", std::string(error.what()) + "; calibrate the camera again");
  }
}

/// Parameters from OpenCV's nine numbers of camera_matrix and its distortion coefficients.
CameraParameters opencv_parameters(const std::vector<double>& K, const std::vector<double>& lens) {
  CameraParameters p;
  p.px = K[0];
  p.py = K[4];
  p.u0 = K[2];
  p.v0 = K[5];
  const bool straight = std::all_of(lens.begin(), lens.end(), [](double d) { return d == 0; });
  p.lens = straight ? Lens::Pinhole : Lens::PlumbBob;
  std::copy(lens.begin(), lens.end(), p.distortion.begin());
  return p;
}

std::string matrix_fault(const std::vector<double>& K) {
  if (K.size() != 9) return "has " + std::to_string(K.size()) + " numbers; give the 9 of a matrix";
  const bool upper = K[3] == 0 && K[6] == 0 && K[7] == 0 && K[8] == 1;
  if (!upper || K[1] != 0) return "is no matrix [fx 0 cx; 0 fy cy; 0 0 1]; check the order (rows)";
  return "";
}

std::string distortion_fault(std::vector<double>& lens) {
  while (lens.size() > 5 && lens.back() == 0) lens.pop_back();
  if (lens.size() == 4 || lens.size() == 5 || lens.empty()) return "";
  return "has " + std::to_string(lens.size()) +
         " coefficients; calibrate with the 4 or 5 of k1 k2 p1 p2 k3 (plumb_bob)";
}

std::vector<double> yaml_matrix(const Section& root, const std::string& key) {
  return root.child(key).numbers("data");
}

Camera load_yaml(const fs::path& file, const std::optional<ImageSize>& size) {
  const Section root = Section::load(file);
  if (!root.has("camera_matrix")) {
    root.fail("camera_matrix",
              "is missing; give a camera as OpenCV or ROS write it, or a ViSP .xml file");
  }
  const std::string model = root.text("distortion_model", "plumb_bob");
  if (model != "plumb_bob") {
    root.fail("distortion_model", "is '" + model + "', which is not read; calibrate as plumb_bob");
  }
  const std::vector<double> K = yaml_matrix(root, "camera_matrix");
  if (const std::string fault = matrix_fault(K); !fault.empty()) root.fail("camera_matrix", fault);
  std::vector<double> lens;
  if (root.has("distortion_coefficients")) lens = yaml_matrix(root, "distortion_coefficients");
  if (const std::string fault = distortion_fault(lens); !fault.empty()) {
    root.fail("distortion_coefficients", fault);
  }
  CameraParameters p = opencv_parameters(K, lens);
  p.width = root.whole("image_width", size ? size->width : 0);
  p.height = root.whole("image_height", size ? size->height : 0);
  return camera_of(p, file, 1);
}

/// ViSP's <model>.
CameraParameters visp_model(const Xml& xml, const pugi::xml_node& model) {
  static const std::map<std::string, std::pair<Lens, std::vector<const char*>>> models = {
      {"perspectiveProjWithoutDistortion", {Lens::Pinhole, {}}},
      {"perspectiveProjWithDistortion", {Lens::VispRadial, {"kud", "kdu"}}},
      {"ProjWithKannalaBrandtDistortion", {Lens::KannalaBrandt, {"k1", "k2", "k3", "k4", "k5"}}},
  };
  const pugi::xml_node type = xml.child(model, "type");
  std::string name = type.text().get();
  name.erase(0, name.find_first_not_of(" \t\r\n"));
  name.erase(name.find_last_not_of(" \t\r\n") + 1);
  const auto known = models.find(name);
  if (known == models.end()) {
    xml.fail(type, "'" + name + "' is no known lens model; give one of ViSP's three");
  }
  CameraParameters p;
  p.lens = known->second.first;
  p.px = xml.number(model, "px");
  p.py = xml.number(model, "py");
  p.u0 = xml.number(model, "u0");
  p.v0 = xml.number(model, "v0");
  std::size_t i = 0;
  for (const char* key : known->second.second) p.distortion[i++] = xml.number(model, key);
  return p;
}

/// The best model of a ViSP <camera>: with radial distortion, else none, else Kannala-Brandt: the
/// order in which ViSP's users try them.
CameraParameters visp_camera(const Xml& xml, const pugi::xml_node& camera) {
  std::map<Lens, CameraParameters> models;
  for (const pugi::xml_node& model : camera.children("model")) {
    const CameraParameters p = visp_model(xml, model);
    if (!models.emplace(p.lens, p).second) xml.fail(model, "of this type is given twice");
  }
  for (const Lens lens : {Lens::VispRadial, Lens::Pinhole, Lens::KannalaBrandt}) {
    const auto found = models.find(lens);
    if (found == models.end()) continue;
    CameraParameters p = found->second;
    p.width = xml.size(camera, "image_width");
    p.height = xml.size(camera, "image_height");
    return p;
  }
  xml.fail(camera, "has no <model>; add one");
}

std::string described(const Xml& xml, const pugi::xml_node& camera) {
  return std::string("'") + camera.child("name").text().get() + "' " +
         std::to_string(xml.size(camera, "image_width")) + "x" +
         std::to_string(xml.size(camera, "image_height"));
}

Camera load_visp(const Xml& xml, const fs::path& file, const std::string& name,
                 const std::optional<ImageSize>& size) {
  std::vector<pugi::xml_node> fitting;
  std::string all;
  for (const pugi::xml_node& camera : xml.root().children("camera")) {
    all += (all.empty() ? "" : ", ") + described(xml, camera);
    if (!name.empty() && name != camera.child("name").text().get()) continue;
    const int width = xml.size(camera, "image_width");
    const int height = xml.size(camera, "image_height");
    if (size && width != 0 && (width != size->width || height != size->height)) continue;
    fitting.push_back(camera);
  }
  if (fitting.empty()) {
    const std::string wanted = (name.empty() ? "" : " named '" + name + "'") +
                               (size ? " for " + std::to_string(size->width) + "x" +
                                           std::to_string(size->height) + " images"
                                     : "");
    xml.fail(xml.root(), "no camera" + wanted + "; " +
                             (all.empty() ? "add a <camera>" : "the file has " + all));
  }
  if (fitting.size() > 1) xml.fail(fitting[1], "several cameras fit (" + all + "); choose one");
  return camera_of(visp_camera(xml, fitting[0]), file, 1);
}

Camera load_opencv_xml(const Xml& xml, const fs::path& file) {
  const pugi::xml_node root = xml.root();
  const pugi::xml_node matrix = xml.child(root, "camera_matrix");
  const std::vector<double> K = xml.numbers_of(xml.child(matrix, "data"), 0);
  if (const std::string fault = matrix_fault(K); !fault.empty()) xml.fail(matrix, fault);
  std::vector<double> lens;
  if (const pugi::xml_node node = root.child("distortion_coefficients")) {
    lens = xml.numbers_of(xml.child(node, "data"), 0);
    if (const std::string fault = distortion_fault(lens); !fault.empty()) xml.fail(node, fault);
  }
  CameraParameters p = opencv_parameters(K, lens);
  p.width = xml.size(root, "image_width");
  p.height = xml.size(root, "image_height");
  return camera_of(p, file, 1);
}

}  // namespace

Camera load_camera(const fs::path& file, const std::string& name,
                   const std::optional<ImageSize>& size) {
  std::string extension = file.extension().string();
  if (extension == ".yaml" || extension == ".yml") return load_yaml(file, size);
  if (extension != ".xml") {
    throw FileError(file, 0, "", "is no camera file; give a .xml, .yml or .yaml file");
  }
  const Xml xml(file);
  const std::string root = xml.root().name();
  if (root == "opencv_storage") return load_opencv_xml(xml, file);
  if (root != "root") {
    xml.fail(xml.root(), "is no camera file of ViSP (<root>) or OpenCV (<opencv_storage>)");
  }
  return load_visp(xml, file, name, size);
}

void require_resolution(const Camera& camera, int width, int height, const fs::path& file) {
  const CameraParameters& p = camera.parameters();
  const bool fits = (p.width == 0 || p.width == width) && (p.height == 0 || p.height == height);
  if (fits) return;
  const auto text = [](int w, int h) { return std::to_string(w) + "x" + std::to_string(h); };
  throw FileError(file, 0, "",
                  "the camera is calibrated for " + text(p.width, p.height) +
                      " images, these are " + text(width, height) +
                      "; calibrate at this size or choose another camera file");
}

}  // namespace kestrel

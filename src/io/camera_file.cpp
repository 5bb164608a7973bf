#include "kestrel/io/camera_file.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "opencv_camera.hpp"
#include "xml_file.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

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

/// The lens that camera_writer puts beside ViSP's models.
CameraParameters plumb_bob(const Xml& xml, const pugi::xml_node& model) {
  CameraParameters p;
  p.lens = Lens::PlumbBob;
  p.px = xml.number(model, "px");
  p.py = xml.number(model, "py");
  p.u0 = xml.number(model, "u0");
  p.v0 = xml.number(model, "v0");
  std::size_t i = 0;
  for (const char* key : {"k1", "k2", "p1", "p2", "k3"}) p.distortion[i++] = xml.number(model, key);
  return p;
}

/// The best model of a ViSP <camera>: plumb-bob beside ViSP's own, else with radial distortion,
/// else none, else Kannala-Brandt: the order in which ViSP's users try them.
CameraParameters visp_camera(const Xml& xml, const pugi::xml_node& camera) {
  std::map<Lens, CameraParameters> models;
  if (const auto beside = camera.child("additional_information").child("plumb_bob")) {
    models.emplace(Lens::PlumbBob, plumb_bob(xml, beside));
  }
  for (const pugi::xml_node& model : camera.children("model")) {
    const CameraParameters p = visp_model(xml, model);
    if (!models.emplace(p.lens, p).second) xml.fail(model, "of this type is given twice");
  }
  for (const Lens lens : {Lens::PlumbBob, Lens::VispRadial, Lens::Pinhole, Lens::KannalaBrandt}) {
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

}  // namespace

Camera load_camera(const fs::path& file, const std::string& name,
                   const std::optional<ImageSize>& size) {
  std::string extension = file.extension().string();
  if (extension == ".yaml" || extension == ".yml") return load_camera_yaml(file, size);
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

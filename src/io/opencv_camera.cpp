#include "opencv_camera.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "kestrel/io/yaml_section.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

/// Parameters from OpenCV's nine numbers of camera_matrix and its distortion coefficients.
CameraParameters opencv_parameters(const std::vector<double>& K, const std::vector<double>& lens,
                                   Lens bent) {
  CameraParameters p;
  p.px = K[0];
  p.py = K[4];
  p.u0 = K[2];
  p.v0 = K[5];
  const bool straight = std::all_of(lens.begin(), lens.end(), [](double d) { return d == 0; });
  p.lens = straight && bent == Lens::PlumbBob ? Lens::Pinhole : bent;
  std::copy(lens.begin(), lens.end(), p.distortion.begin());
  return p;
}

std::string matrix_fault(const std::vector<double>& K) {
  if (K.size() != 9) return "has " + std::to_string(K.size()) + " numbers; give the 9 of a matrix";
  const bool upper = K[3] == 0 && K[6] == 0 && K[7] == 0 && K[8] == 1;
  if (!upper || K[1] != 0) return "is no matrix [fx 0 cx; 0 fy cy; 0 0 1]; check the order (rows)";
  return "";
}

/// What is wrong with the number of coefficients; drops zeros that no model of ours has.
std::string distortion_fault(std::vector<double>& lens, Lens model) {
  if (model == Lens::KannalaBrandt) {
    if (lens.size() == 4) return "";
    return "has " + std::to_string(lens.size()) +
           " coefficients; give the 4 of a fisheye, k1 to k4";
  }
  while (lens.size() > 5 && lens.back() == 0) lens.pop_back();
  if (lens.size() == 4 || lens.size() == 5 || lens.empty()) return "";
  return "has " + std::to_string(lens.size()) +
         " coefficients; calibrate with the 4 or 5 of k1 k2 p1 p2 k3 (plumb_bob)";
}

std::vector<double> yaml_matrix(const Section& root, const std::string& key) {
  return root.child(key).numbers("data");
}

/// The lens that a YAML file names: ROS by distortion_model, OpenCV's tutorial by fisheye_model.
Lens yaml_lens(const Section& root) {
  const std::vector<std::pair<std::string, Lens>> models = {{"plumb_bob", Lens::PlumbBob},
                                                            {"equidistant", Lens::KannalaBrandt},
                                                            {"fisheye", Lens::KannalaBrandt}};
  const std::string model = root.text("distortion_model", "plumb_bob");
  for (const auto& [name, lens] : models) {
    if (name != model) continue;
    return root.whole("fisheye_model", 0) != 0 ? Lens::KannalaBrandt : lens;
  }
  root.fail("distortion_model",
            "is '" + model + "', which is not read; calibrate as plumb_bob or equidistant");
}

}  // namespace

Camera load_camera_yaml(const fs::path& file, const std::optional<ImageSize>& size) {
  const Section root = Section::load(file);
  if (!root.has("camera_matrix")) {
    root.fail("camera_matrix",
              "is missing; give a camera as OpenCV or ROS write it, or a ViSP .xml file");
  }
  const Lens model = yaml_lens(root);
  const std::vector<double> K = yaml_matrix(root, "camera_matrix");
  if (const std::string fault = matrix_fault(K); !fault.empty()) root.fail("camera_matrix", fault);
  std::vector<double> lens;
  if (root.has("distortion_coefficients")) lens = yaml_matrix(root, "distortion_coefficients");
  if (const std::string fault = distortion_fault(lens, model); !fault.empty()) {
    root.fail("distortion_coefficients", fault);
  }
  CameraParameters p = opencv_parameters(K, lens, model);
  p.width = root.whole("image_width", size ? size->width : 0);
  p.height = root.whole("image_height", size ? size->height : 0);
  return camera_of(p, file, 1);
}

Camera load_opencv_xml(const Xml& xml, const fs::path& file) {
  const pugi::xml_node root = xml.root();
  const pugi::xml_node matrix = xml.child(root, "camera_matrix");
  const std::vector<double> K = xml.numbers_of(xml.child(matrix, "data"), 0);
  if (const std::string fault = matrix_fault(K); !fault.empty()) xml.fail(matrix, fault);
  const pugi::xml_node fisheye = root.child("fisheye_model");
  const Lens model =
      fisheye && xml.numbers_of(fisheye, 1)[0] != 0 ? Lens::KannalaBrandt : Lens::PlumbBob;
  std::vector<double> lens;
  if (const pugi::xml_node node = root.child("distortion_coefficients")) {
    lens = xml.numbers_of(xml.child(node, "data"), 0);
    if (const std::string fault = distortion_fault(lens, model); !fault.empty()) {
      xml.fail(node, fault);
    }
  }
  CameraParameters p = opencv_parameters(K, lens, model);
  p.width = xml.size(root, "image_width");
  p.height = xml.size(root, "image_height");
  return camera_of(p, file, 1);
}

Camera camera_of(const CameraParameters& parameters, const fs::path& file, int line) {
  try {
    return Camera(parameters);
  } catch (const std::invalid_argument& error) {
    throw FileError(file, line, "", std::string(error.what()) + "; calibrate the camera again");
  }
}

}  // namespace kestrel

#include "kestrel/calibration/camera_model.hpp"

namespace kestrel {
namespace {

/// Of a model: its lens, and which of the lens's coefficients are free.
struct Freedom {
  Lens lens;
  std::vector<std::pair<const char*, std::size_t>> coefficients;
};

Freedom freedom(CameraModel model) {
  switch (model) {
    case CameraModel::None:
      break;
    case CameraModel::Radial:
      return {Lens::PlumbBob, {{"k1", 0}}};
    case CameraModel::RadialTangential:
      return {Lens::PlumbBob, {{"k1", 0}, {"k2", 1}, {"p1", 2}, {"p2", 3}}};
    case CameraModel::RadialTangential3:
      return {Lens::PlumbBob, {{"k1", 0}, {"k2", 1}, {"p1", 2}, {"p2", 3}, {"k3", 4}}};
    case CameraModel::KannalaBrandt:
      return {Lens::KannalaBrandt, {{"k1", 0}, {"k2", 1}, {"k3", 2}, {"k4", 3}}};
  }
  return {Lens::Pinhole, {}};
}

}  // namespace

std::vector<CameraModel> camera_models() {
  return {CameraModel::None, CameraModel::Radial, CameraModel::RadialTangential,
          CameraModel::RadialTangential3, CameraModel::KannalaBrandt};
}

const char* name(CameraModel model) {
  switch (model) {
    case CameraModel::None:
      return "none";
    case CameraModel::Radial:
      return "radial";
    case CameraModel::RadialTangential:
      return "radial-tangential";
    case CameraModel::RadialTangential3:
      return "radial-tangential-k3";
    case CameraModel::KannalaBrandt:
      return "kannala-brandt";
  }
  return "unknown";
}

std::optional<CameraModel> camera_model_named(const std::string& word) {
  if (word == "fisheye") return CameraModel::KannalaBrandt;
  for (const CameraModel model : camera_models())
    if (word == name(model)) return model;
  return std::nullopt;
}

std::vector<ModelParameter> parameters_of(CameraModel model) {
  std::vector<ModelParameter> all{{"fx", "px"}, {"fy", "px"}, {"cx", "px"}, {"cy", "px"}};
  for (const auto& [word, place] : freedom(model).coefficients) all.push_back({word, ""});
  return all;
}

std::vector<double> values_of(CameraModel model, const CameraParameters& camera) {
  std::vector<double> values{camera.px, camera.py, camera.u0, camera.v0};
  for (const auto& [word, place] : freedom(model).coefficients)
    values.push_back(camera.distortion[place]);
  return values;
}

CameraParameters camera_with(CameraModel model, const std::vector<double>& values, int width,
                             int height) {
  CameraParameters camera{values[0], values[1], values[2], values[3], width, height};
  const Freedom free = freedom(model);
  camera.lens = free.lens;
  std::size_t i = 4;
  for (const auto& [word, place] : free.coefficients) camera.distortion[place] = values[i++];
  return camera;
}

}  // namespace kestrel

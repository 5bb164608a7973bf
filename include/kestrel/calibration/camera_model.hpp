#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kestrel/geometry/camera.hpp"

namespace kestrel {

/// Which lens a calibration looks for; the principal point and both focal lengths are free in all.
enum class CameraModel {
  None,               // no distortion
  Radial,             // k1: ViSP's kud
  RadialTangential,   // k1 k2 p1 p2
  RadialTangential3,  // k1 k2 p1 p2 k3: OpenCV's usual five
  KannalaBrandt,      // k1 k2 k3 k4 of the angle: fisheye
};

/// All of them, the simplest first.
std::vector<CameraModel> camera_models();

/// Its name on the command line: "none", "radial", "radial-tangential", "radial-tangential-k3",
/// "kannala-brandt".
const char* name(CameraModel model);

/// The model of that name ("fisheye" is kannala-brandt, too); empty when there is none.
std::optional<CameraModel> camera_model_named(const std::string& name);

/// A number that a calibration looks for.
struct ModelParameter {
  std::string name;  // fx, fy, cx, cy, k1, ...
  std::string unit;  // "px" or none
};

/// The numbers of a model, in this order: focal lengths, principal point, lens.
std::vector<ModelParameter> parameters_of(CameraModel model);

/// Their values in a camera, in that order.
std::vector<double> values_of(CameraModel model, const CameraParameters& camera);

/// A camera of this model with these values (as many as parameters_of gives), for images of
/// this size, px. Not checked: Camera's constructor does that.
CameraParameters camera_with(CameraModel model, const std::vector<double>& values, int width,
                             int height);

}  // namespace kestrel

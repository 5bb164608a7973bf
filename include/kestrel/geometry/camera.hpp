#pragma once

#include <array>

#include <Eigen/Core>

#include "kestrel/geometry/pixel.hpp"

namespace kestrel {

/// How the lens departs from a pinhole.
enum class Lens {
  Pinhole,        // no distortion
  VispRadial,     // ViSP's perspectiveProjWithDistortion: {kud, kdu}, two approximate inverses
  PlumbBob,       // OpenCV's and ROS's: {k1, k2, p1, p2, k3}
  KannalaBrandt,  // ViSP's ProjWithKannalaBrandtDistortion, OpenCV's fisheye: {k1 .. k4}
};

/// Parameters of a calibrated camera as the files give them.
struct CameraParameters {
  double px = 0;  // focal length over pixel width, px
  double py = 0;
  double u0 = 0;  // principal point, px
  double v0 = 0;
  int width = 0;  // image size the calibration holds for; 0: unknown
  int height = 0;
  Lens lens = Lens::Pinhole;
  std::array<double, 5> distortion{};
};

/// A calibrated camera: the only way between pixels and the normalised image plane.
class Camera {
 public:
  /// Throws std::invalid_argument for non-finite numbers, px or py <= 0, or a negative size.
  explicit Camera(const CameraParameters& parameters);

  const CameraParameters& parameters() const { return parameters_; }

  /// Intrinsic matrix K (without the lens).
  Eigen::Matrix3d K() const;  // NOLINT(readability-identifier-naming)

  /// Where a point of the normalised plane appears, px, lens included; not finite beyond the lens
  /// model's monotonic range, where it would fold back into the image.
  Pixel to_pixel(const ImagePoint& point) const;

  /// Derivative of to_pixel by the point, px per unit of the normalised plane.
  Eigen::Matrix2d pixel_jacobian(const ImagePoint& point) const;

  /// Normalised, undistorted point of a pixel. Plumb-bob and Kannala-Brandt are inverted by
  /// Newton's method to 1e-12; ViSP's radial model by its own second polynomial, kdu. Not finite
  /// where no point of the monotonic range appears at the pixel.
  ImagePoint to_image_point(const Pixel& pixel) const;

 private:
  CameraParameters parameters_;
  double outward_range_ = 0;  // radius, or angle off axis (rad) for Kannala-Brandt
  double inward_range_ = 0;   // distorted radius, for VispRadial
};

}  // namespace kestrel

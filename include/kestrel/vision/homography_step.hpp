#pragma once

#include <optional>

#include <Eigen/Core>

#include "kestrel/geometry/homography.hpp"

namespace kestrel {

/// A homography from the template scaled to [-1, 1] x [-1, 1] (its corner pixels' centres at +-1)
/// to the image, px. Scaled to G(2,2) = 1: the depth is 1 at the template's centre, and the other
/// elements of the last row say how much of it is gained towards the right and the lower edge.
struct CentredHomography {
  Eigen::Matrix3d G = Eigen::Matrix3d::Identity();
};

/// A point of the template, px, in the scaled coordinates: (-1, -1) for the first pixel.
Eigen::Vector2d centred(const Pixel& in_template, double width_px, double height_px);

/// The same map from scaled coordinates; not finite when the centre of the template is at infinity.
CentredHomography centred(const Homography& image_from_template, double width_px, double height_px);

/// The same map from pixels, scaled to H(2,2) = 1; empty when the template's pixel (0, 0) is at
/// infinity or the map is not finite.
std::optional<Homography> uncentred(const CentredHomography& image_from_scaled, double width_px,
                                    double height_px);

/// Image of a scaled point, and its depth, 1 at the template's centre.
struct Seen {
  double u;
  double v;
  double depth;
};

inline Seen seen(const CentredHomography& image_from_scaled, const Eigen::Vector2d& p) {
  const Eigen::Matrix3d& G = image_from_scaled.G;
  const double depth = G(2, 0) * p.x() + G(2, 1) * p.y() + 1;
  const double one = 1 / depth;
  return {(G(0, 0) * p.x() + G(0, 1) * p.y() + G(0, 2)) * one,
          (G(1, 0) * p.x() + G(1, 1) * p.y() + G(1, 2)) * one, depth};
}

/// One Gauss-Newton step of the weighted least-squares fit of a homography to its reprojection
/// error (Hartley & Zisserman 2004, section 4.5 and A6.2): pairs are added, then the step is taken.
/// The two rows of a pair's Jacobian share three numbers, so that 27 sums hold the 8 x 8 normal
/// equations, and two 3 x 3 blocks are eliminated from them (Schur complement).
class HomographyStep {
 public:
  using Information = Eigen::Matrix<double, 8, 8>;
  using Jacobian = Eigen::Matrix<double, 2, 8>;

  explicit HomographyStep(const CentredHomography& at) : at_(at) {}

  /// Adds a pair: a scaled point, where it was seen, px, and the inverse variance of that, px^-2.
  void add(const Eigen::Vector2d& p, const Pixel& in_image, double weight) {
    add(p, seen(at_, p), in_image, weight);
  }

  /// The same where the model's image of the point is already known.
  void add(const Eigen::Vector2d& p, const Seen& modelled, const Pixel& in_image, double weight);

  /// The homography after the step; empty when the pairs do not determine it. `perspective` is the
  /// inverse variance of the first two elements of the last row around 0 that is known beforehand:
  /// 0 for nothing, large for an affine map.
  std::optional<CentredHomography> taken(double perspective) const;

  /// Inverse covariance of the eight elements, in the order of the rows.
  Information information() const;

  /// Derivative of the image of a scaled point, px, by the eight elements in the order of the rows.
  static Jacobian jacobian(const CentredHomography& at, const Eigen::Vector2d& p);

 private:
  CentredHomography at_;
  // Sums over pairs of weight times products of a = (x, y, 1) / depth, (u, v) and the residual.
  double xx_ = 0, xy_ = 0, yy_ = 0, x_ = 0, y_ = 0, one_ = 0;
  double u_xx_ = 0, u_xy_ = 0, u_yy_ = 0, u_x_ = 0, u_y_ = 0;
  double v_xx_ = 0, v_xy_ = 0, v_yy_ = 0, v_x_ = 0, v_y_ = 0;
  double s_xx_ = 0, s_xy_ = 0, s_yy_ = 0;  // of u^2 + v^2
  Eigen::Vector3d gu_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d gv_ = Eigen::Vector3d::Zero();
  Eigen::Vector2d gh_ = Eigen::Vector2d::Zero();
};

inline void HomographyStep::add(const Eigen::Vector2d& p, const Seen& modelled,
                                const Pixel& in_image, double weight) {
  const auto [u, v, depth] = modelled;
  const double one = 1 / depth;
  const double x = p.x() * one;
  const double y = p.y() * one;
  const double du = in_image.u - u;
  const double dv = in_image.v - v;
  const double wx = weight * x;
  const double wy = weight * y;
  const double w1 = weight * one;
  const double xx = wx * x;
  const double xy = wx * y;
  const double yy = wy * y;
  const double x1 = wx * one;
  const double y1 = wy * one;
  xx_ += xx, xy_ += xy, yy_ += yy, x_ += x1, y_ += y1, one_ += w1 * one;
  u_xx_ += u * xx, u_xy_ += u * xy, u_yy_ += u * yy, u_x_ += u * x1, u_y_ += u * y1;
  v_xx_ += v * xx, v_xy_ += v * xy, v_yy_ += v * yy, v_x_ += v * x1, v_y_ += v * y1;
  const double s = u * u + v * v;
  s_xx_ += s * xx, s_xy_ += s * xy, s_yy_ += s * yy;
  gu_ += du * Eigen::Vector3d(wx, wy, w1);
  gv_ += dv * Eigen::Vector3d(wx, wy, w1);
  gh_ -= (du * u + dv * v) * Eigen::Vector2d(wx, wy);
}

}  // namespace kestrel

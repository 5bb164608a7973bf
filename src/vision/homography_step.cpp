#include "kestrel/vision/homography_step.hpp"

#include <cmath>

#include <Eigen/LU>

namespace kestrel {
namespace {

/// A pivot below this share of its diagonal element is rounding: the pairs say nothing about it.
constexpr double kPivotTolerance = 1e-10;

Eigen::Matrix3d template_from_scaled(double width_px, double height_px) {
  const double half_width = (width_px - 1) / 2;
  const double half_height = (height_px - 1) / 2;
  Eigen::Matrix3d T;
  T << half_width, 0, half_width, 0, half_height, half_height, 0, 0, 1;
  return T;
}

/// Inverse of the symmetric A by cofactors; empty when its pivots are rounding.
std::optional<Eigen::Matrix3d> inverse(const Eigen::Matrix3d& A) {
  const double second = A(0, 0) * A(1, 1) - A(0, 1) * A(0, 1);
  const double third = A.determinant();
  if (!(A(0, 0) > 0 && A(2, 2) > 0 && second > kPivotTolerance * A(0, 0) * A(1, 1) &&
        third > kPivotTolerance * second * A(2, 2))) {
    return std::nullopt;
  }
  return Eigen::Matrix3d(A.inverse());
}

}  // namespace

Eigen::Vector2d centred(const Pixel& in_template, double width_px, double height_px) {
  return {2 * in_template.u / (width_px - 1) - 1, 2 * in_template.v / (height_px - 1) - 1};
}

CentredHomography centred(const Homography& image_from_template, double width_px,
                          double height_px) {
  const Eigen::Matrix3d G = image_from_template.H * template_from_scaled(width_px, height_px);
  return {G / G(2, 2)};
}

std::optional<Homography> uncentred(const CentredHomography& image_from_scaled, double width_px,
                                    double height_px) {
  const double sx = 2 / (width_px - 1);
  const double sy = 2 / (height_px - 1);
  Eigen::Matrix3d S;
  S << sx, 0, -1, 0, sy, -1, 0, 0, 1;
  const Eigen::Matrix3d H = image_from_scaled.G * S;
  if (!H.allFinite() || !(std::abs(H(2, 2)) > 1e-12 * H.cwiseAbs().maxCoeff())) return std::nullopt;
  return Homography{H / H(2, 2)};
}

std::optional<CentredHomography> HomographyStep::taken(double perspective) const {
  Eigen::Matrix3d A;
  A << xx_, xy_, x_, xy_, yy_, y_, x_, y_, one_;
  const auto inverse_A = inverse(A);
  if (!inverse_A) return std::nullopt;
  Eigen::Matrix<double, 3, 2> U;
  U << u_xx_, u_xy_, u_xy_, u_yy_, u_x_, u_y_;
  Eigen::Matrix<double, 3, 2> V;
  V << v_xx_, v_xy_, v_xy_, v_yy_, v_x_, v_y_;
  const Eigen::Matrix<double, 3, 2> X = *inverse_A * U;
  const Eigen::Matrix<double, 3, 2> Y = *inverse_A * V;
  Eigen::Matrix2d C;
  C << s_xx_ + perspective, s_xy_, s_xy_, s_yy_ + perspective;
  const Eigen::Matrix2d S = C - U.transpose() * X - V.transpose() * Y;
  const double determinant = S(0, 0) * S(1, 1) - S(0, 1) * S(0, 1);
  if (!(S(0, 0) > kPivotTolerance * C(0, 0) && determinant > kPivotTolerance * S(0, 0) * C(1, 1))) {
    return std::nullopt;
  }
  const Eigen::Vector2d known = perspective * at_.G.block<1, 2>(2, 0).transpose();
  const Eigen::Vector2d b = gh_ - known + X.transpose() * gu_ + Y.transpose() * gv_;
  const Eigen::Vector2d h =
      Eigen::Vector2d(S(1, 1) * b[0] - S(0, 1) * b[1], S(0, 0) * b[1] - S(0, 1) * b[0]) /
      determinant;
  CentredHomography next = at_;
  next.G.row(0) += (*inverse_A * gu_ + X * h).transpose();
  next.G.row(1) += (*inverse_A * gv_ + Y * h).transpose();
  next.G.block<1, 2>(2, 0) += h.transpose();
  return next;
}

HomographyStep::Information HomographyStep::information() const {
  Eigen::Matrix3d A;
  A << xx_, xy_, x_, xy_, yy_, y_, x_, y_, one_;
  Information M = Information::Zero();
  M.block<3, 3>(0, 0) = A;
  M.block<3, 3>(3, 3) = A;
  M.block<3, 2>(0, 6) << -u_xx_, -u_xy_, -u_xy_, -u_yy_, -u_x_, -u_y_;
  M.block<3, 2>(3, 6) << -v_xx_, -v_xy_, -v_xy_, -v_yy_, -v_x_, -v_y_;
  M.block<2, 6>(6, 0) = M.block<6, 2>(0, 6).transpose();
  M.block<2, 2>(6, 6) << s_xx_, s_xy_, s_xy_, s_yy_;
  return M;
}

HomographyStep::Jacobian HomographyStep::jacobian(const CentredHomography& at,
                                                  const Eigen::Vector2d& p) {
  const auto [u, v, depth] = seen(at, p);
  const double x = p.x() / depth;
  const double y = p.y() / depth;
  const double one = 1 / depth;
  Jacobian J;
  J << x, y, one, 0, 0, 0, -x * u, -y * u,  //
      0, 0, 0, x, y, one, -x * v, -y * v;
  return J;
}

}  // namespace kestrel

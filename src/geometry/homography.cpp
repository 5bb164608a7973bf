#include "kestrel/geometry/homography.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <Eigen/SVD>

namespace kestrel {
namespace {

/// Similarity that moves points to mean 0 and mean distance sqrt(2); empty when they coincide or
/// are not finite.
std::optional<Eigen::Matrix3d> normaliser(const std::vector<PixelPair>& pairs,
                                          Pixel PixelPair::*side) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const PixelPair& pair : pairs) mean += Eigen::Vector2d((pair.*side).u, (pair.*side).v);
  mean /= double(pairs.size());
  double spread = 0;
  for (const PixelPair& pair : pairs) {
    spread += (Eigen::Vector2d((pair.*side).u, (pair.*side).v) - mean).norm();
  }
  spread /= double(pairs.size());
  if (!std::isfinite(spread) || spread <= 0) return std::nullopt;
  const double s = std::sqrt(2.0) / spread;
  Eigen::Matrix3d T;
  T << s, 0, -s * mean.x(), 0, s, -s * mean.y(), 0, 0, 1;
  return T;
}

using System = Eigen::Matrix<double, Eigen::Dynamic, 8>;

/// Eq. (5): two rows a pair, in normalised coordinates.
void fill(const std::vector<PixelPair>& pairs, const Eigen::Matrix3d& T, const Eigen::Matrix3d& U,
          System& A, Eigen::VectorXd& b) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double x = T(0, 0) * pairs[i].in_template.u + T(0, 2);
    const double y = T(1, 1) * pairs[i].in_template.v + T(1, 2);
    const double xp = U(0, 0) * pairs[i].in_image.u + U(0, 2);
    const double yp = U(1, 1) * pairs[i].in_image.v + U(1, 2);
    const auto r = Eigen::Index(2 * i);
    A.row(r) << x, y, 1, 0, 0, 0, -x * xp, -y * xp;
    A.row(r + 1) << 0, 0, 0, x, y, 1, -x * yp, -y * yp;
    b[r] = xp;
    b[r + 1] = yp;
  }
}

/// Below this ratio of singular values the points do not determine the eight parameters: 1e-9 is
/// three points of four within 1e-6 of the template's size of a line, far less than any noise.
constexpr double kRankTolerance = 1e-9;

std::optional<Eigen::Matrix<double, 8, 1>> solve(const System& A, const Eigen::VectorXd& b) {
  const Eigen::JacobiSVD<System> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const auto& values = svd.singularValues();
  if (!(values[7] > kRankTolerance * values[0])) return std::nullopt;
  return Eigen::Matrix<double, 8, 1>(svd.solve(b));
}

}  // namespace

Pixel operator*(const Homography& image_from_template, const Pixel& in_template) {
  const Eigen::Vector3d p =
      image_from_template.H * Eigen::Vector3d(in_template.u, in_template.v, 1);
  return {p.x() / p.z(), p.y() / p.z()};
}

std::array<Pixel, 4> template_corners(double width_px, double height_px) {
  const double right = width_px - 1;
  const double bottom = height_px - 1;
  return {{{0, 0}, {right, 0}, {right, bottom}, {0, bottom}}};
}

std::array<Pixel, 4> outline(const Homography& image_from_template, double width_px,
                             double height_px) {
  std::array<Pixel, 4> corners = template_corners(width_px, height_px);
  for (Pixel& corner : corners) corner = image_from_template * corner;
  return corners;
}

std::optional<Homography> fit_homography(const std::vector<PixelPair>& pairs) {
  if (pairs.size() < 4) return std::nullopt;
  const auto T = normaliser(pairs, &PixelPair::in_template);
  const auto U = normaliser(pairs, &PixelPair::in_image);
  if (!T || !U) return std::nullopt;
  System A(2 * pairs.size(), 8);
  Eigen::VectorXd b(2 * pairs.size());
  fill(pairs, *T, *U, A, b);
  const auto h = solve(A, b);
  if (!h) return std::nullopt;
  Eigen::Matrix3d N;
  N << (*h)[0], (*h)[1], (*h)[2], (*h)[3], (*h)[4], (*h)[5], (*h)[6], (*h)[7], 1;
  const Eigen::Matrix3d H = U->inverse() * N * *T;
  if (!H.allFinite() || std::abs(H(2, 2)) < 1e-12 * H.cwiseAbs().maxCoeff()) return std::nullopt;
  return Homography{H / H(2, 2)};
}

double signed_area(const std::array<Pixel, 4>& corners) {
  double twice = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Pixel& a = corners[i];
    const Pixel& b = corners[(i + 1) % 4];
    twice += a.u * b.v - b.u * a.v;
  }
  return twice / 2;
}

bool is_plausible(const Homography& image_from_template, double width_px, double height_px,
                  const OutlineOptions& options) {
  const Eigen::Matrix3d& H = image_from_template.H;
  if (!H.allFinite()) return false;
  double sign = 0;
  for (const Pixel& p : template_corners(width_px, height_px)) {
    const double depth = H.row(2).dot(Eigen::Vector3d(p.u, p.v, 1));
    if (sign == 0) sign = depth;
    if (!(depth * sign > 0)) return false;  // a corner at infinity or behind the camera
  }
  const std::array<Pixel, 4> corners = outline(image_from_template, width_px, height_px);
  for (std::size_t i = 0; i < 4; ++i) {
    const Pixel& a = corners[i];
    const Pixel& b = corners[(i + 1) % 4];
    const Pixel& c = corners[(i + 2) % 4];
    const double turn = (b.u - a.u) * (c.v - b.v) - (b.v - a.v) * (c.u - b.u);
    if (!(turn > 0)) return false;  // not convex, or mirrored
    if (distance(a, b) < options.min_side_px) return false;
  }
  const double ratio = signed_area(corners) / ((width_px - 1) * (height_px - 1));
  return ratio >= options.min_area_ratio && ratio <= options.max_area_ratio;
}

}  // namespace kestrel

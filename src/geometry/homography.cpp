#include "kestrel/geometry/homography.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
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

/// The pairs in normalised coordinates.
struct Normalised {
  Eigen::Matrix3d T;  // of the template's points
  Eigen::Matrix3d U;  // of the image's
  std::vector<PixelPair> pairs;
};

std::optional<Normalised> normalised(const std::vector<PixelPair>& pairs) {
  const auto T = normaliser(pairs, &PixelPair::in_template);
  const auto U = normaliser(pairs, &PixelPair::in_image);
  if (!T || !U) return std::nullopt;
  const auto apply = [](const Eigen::Matrix3d& S, const Pixel& p) {
    return Pixel{S(0, 0) * p.u + S(0, 2), S(1, 1) * p.v + S(1, 2)};
  };
  Normalised out{*T, *U, pairs};
  for (PixelPair& pair : out.pairs) {
    pair = {apply(*T, pair.in_template), apply(*U, pair.in_image)};
  }
  return out;
}

/// A point this near (in units of the points' spread) to the line through two others is on it: a
/// thousandth of a pixel on a template of a thousand, far less than any noise.
constexpr double kOnALine = 1e-6;

/// The projective basis of four points (columns): takes the unit vectors to the first three and
/// (1, 1, 1) to the fourth. Empty when three are on a line.
std::optional<Eigen::Matrix3d> basis(const std::vector<PixelPair>& pairs, Pixel PixelPair::*side) {
  const auto point = [&](std::size_t i) {
    return Eigen::Vector3d((pairs[i].*side).u, (pairs[i].*side).v, 1);
  };
  Eigen::Matrix3d P;
  P << point(0), point(1), point(2);
  const Eigen::Vector3d d = point(3);
  // Twice the areas of the triangles with d, then of the first three.
  const Eigen::Vector3d areas(P.col(1).cross(P.col(2)).dot(d), P.col(2).cross(P.col(0)).dot(d),
                              P.col(0).cross(P.col(1)).dot(d));
  if (!(areas.cwiseAbs().minCoeff() > kOnALine)) return std::nullopt;
  if (!(std::abs(P.determinant()) > kOnALine)) return std::nullopt;
  return Eigen::Matrix3d(P * areas.asDiagonal());
}

/// The exact solution of eq. (5) for four pairs by their projective bases (Hartley & Zisserman
/// 2004, 2.3): the same answer as by SVD at a fraction of the time, which RANSAC spends thousands
/// of times a frame.
std::optional<Eigen::Matrix3d> through_four(const std::vector<PixelPair>& pairs) {
  const auto from = basis(pairs, &PixelPair::in_template);
  const auto to = basis(pairs, &PixelPair::in_image);
  if (!from || !to) return std::nullopt;
  return Eigen::Matrix3d(*to * from->inverse());
}

/// Below this ratio of singular values the template's points do not determine the eight parameters.
constexpr double kRankTolerance = 1e-7;

/// The least-squares solution of eq. (5), two rows a pair, by SVD.
std::optional<Eigen::Matrix3d> through_many(const std::vector<PixelPair>& pairs) {
  using System = Eigen::MatrixXd;  // 2n x 8
  System A(2 * pairs.size(), 8);
  Eigen::VectorXd b(2 * pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& [x, y] = pairs[i].in_template;
    const auto& [xp, yp] = pairs[i].in_image;
    const auto r = Eigen::Index(2 * i);
    A.row(r) << x, y, 1, 0, 0, 0, -x * xp, -y * xp;
    A.row(r + 1) << 0, 0, 0, x, y, 1, -x * yp, -y * yp;
    b[r] = xp;
    b[r + 1] = yp;
  }
  const Eigen::JacobiSVD<System> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const auto& values = svd.singularValues();
  if (!(values[7] > kRankTolerance * values[0])) return std::nullopt;
  const Eigen::Matrix<double, 8, 1> h = svd.solve(b);
  Eigen::Matrix3d N;
  N << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1;
  return N;
}

/// True when the map has an inverse: one without takes the plane to a line.
bool is_invertible(const Eigen::Matrix3d& N) {
  const double size = N.cwiseAbs().maxCoeff();
  return std::isfinite(size) && std::abs(N.determinant()) > kOnALine * size * size * size;
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
  const auto points = normalised(pairs);
  if (!points) return std::nullopt;
  const auto N = pairs.size() == 4 ? through_four(points->pairs) : through_many(points->pairs);
  if (!N || !is_invertible(*N)) return std::nullopt;
  const Eigen::Matrix3d H = points->U.inverse() * *N * points->T;
  if (!H.allFinite() || !(std::abs(H(2, 2)) > 1e-12 * H.cwiseAbs().maxCoeff())) return std::nullopt;
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

std::optional<Homography> homography_from_outline(const std::array<Pixel, 4>& corners,
                                                  double width_px, double height_px) {
  const auto& [a, b, c, d] = corners;
  // The unit square to the four points: p = (g x + h y) q + ... with the sum of opposite corners
  // telling how far the outline is from a parallelogram.
  const double su = a.u - b.u + c.u - d.u;
  const double sv = a.v - b.v + c.v - d.v;
  const double du1 = b.u - c.u;
  const double dv1 = b.v - c.v;
  const double du2 = d.u - c.u;
  const double dv2 = d.v - c.v;
  const double area = du1 * dv2 - du2 * dv1;
  const double g = (su * dv2 - du2 * sv) / area;
  const double h = (du1 * sv - su * dv1) / area;
  Eigen::Matrix3d square;
  square << b.u - a.u + g * b.u, d.u - a.u + h * d.u, a.u,  //
      b.v - a.v + g * b.v, d.v - a.v + h * d.v, a.v,        //
      g, h, 1;
  const Eigen::Vector3d to_square(1 / (width_px - 1), 1 / (height_px - 1), 1);
  const Homography H{square * to_square.asDiagonal()};
  if (!H.H.allFinite() || !(std::abs(H.H.determinant()) > kOnALine)) return std::nullopt;
  return H;
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

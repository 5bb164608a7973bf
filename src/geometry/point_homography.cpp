#include "kestrel/geometry/point_homography.hpp"

#include <Eigen/SVD>

#include "kestrel/geometry/homography.hpp"

namespace kestrel {
namespace {

/// A third singular value below this share of the first is rounding: the plane seen edge-on.
constexpr double kSmallestShare = 1e-12;

}  // namespace

std::optional<Eigen::Matrix3d> euclidean_homography(const Eigen::Matrix3d& H,
                                                    const std::vector<ImagePoint>& a) {
  if (!H.allFinite() || a.empty()) return std::nullopt;
  const Eigen::Vector3d sizes = Eigen::JacobiSVD<Eigen::Matrix3d>(H).singularValues();
  if (!(sizes[2] > kSmallestShare * sizes[0])) return std::nullopt;
  std::size_t in_front = 0;
  for (const ImagePoint& p : a) in_front += H.row(2).dot(Eigen::Vector3d(p.x, p.y, 1)) > 0 ? 1 : 0;
  if (in_front != 0 && in_front != a.size()) return std::nullopt;
  return Eigen::Matrix3d(H / (in_front == 0 ? -sizes[1] : sizes[1]));
}

std::optional<Eigen::Matrix3d> point_homography(const std::vector<ImagePoint>& a,
                                                const std::vector<ImagePoint>& b) {
  if (a.size() != b.size()) return std::nullopt;
  std::vector<PixelPair> pairs;
  pairs.reserve(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) pairs.push_back({{a[i].x, a[i].y}, {b[i].x, b[i].y}});
  const auto fitted = fit_homography(pairs);
  if (!fitted) return std::nullopt;
  return euclidean_homography(fitted->H, a);
}

}  // namespace kestrel

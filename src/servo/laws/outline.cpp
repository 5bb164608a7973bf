#include "outline.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>

namespace kestrel::laws {
namespace {

using Order = std::vector<std::size_t>;

double turn(const ImagePoint& a, const ImagePoint& b, const ImagePoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

constexpr int kBinomial[5][5] = {
    {1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}};

using Powers = std::array<double, 5>;

Powers powers(double x) { return {1, x, x * x, x * x * x, x * x * x * x}; }

/// What the triangle of the origin and an edge (a, b) has of the moment pq, without the common
/// factor (Steger 1996).
double edge_moment(const Powers& ax, const Powers& ay, const Powers& bx, const Powers& by, int p,
                   int q) {
  double sum = 0;
  for (int i = 0; i <= p; ++i) {
    for (int j = 0; j <= q; ++j) {
      sum += kBinomial[i + j][j] * kBinomial[p + q - i - j][q - j] * bx[std::size_t(i)] *
             ax[std::size_t(p - i)] * by[std::size_t(j)] * ay[std::size_t(q - j)];
    }
  }
  return sum;
}

using Corners = std::vector<Eigen::Vector2d>;
using Moments = std::array<std::array<double, 5>, 5>;

/// Moments about the origin up to this order, signed like the area.
Moments polygon_moments(const Corners& corners, int order) {
  Moments m{};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector2d& a = corners[k];
    const Eigen::Vector2d& b = corners[(k + 1) % corners.size()];
    const double twice = a.x() * b.y() - b.x() * a.y();
    const Powers ax = powers(a.x()), ay = powers(a.y()), bx = powers(b.x()), by = powers(b.y());
    for (int p = 0; p <= order; ++p) {
      for (int q = 0; p + q <= order; ++q) {
        m[std::size_t(p)][std::size_t(q)] += twice * edge_moment(ax, ay, bx, by, p, q) /
                                             ((p + q + 2) * (p + q + 1) * kBinomial[p + q][p]);
      }
    }
  }
  return m;
}

}  // namespace

Order outline_order(const std::vector<Feature>& desired) {
  Order sorted(desired.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t(0));
  const auto at = [&](std::size_t i) -> const ImagePoint& { return desired[i].at; };
  std::sort(sorted.begin(), sorted.end(), [&](std::size_t i, std::size_t j) {
    return at(i).x < at(j).x || (at(i).x == at(j).x && at(i).y < at(j).y);
  });
  Order hull;  // Andrew's monotone chain: the one side, then back along the other
  const auto add = [&](std::size_t i, std::size_t first) {
    while (hull.size() >= first + 2 &&
           turn(at(hull[hull.size() - 2]), at(hull.back()), at(i)) <= 0) {
      hull.pop_back();
    }
    hull.push_back(i);
  };
  for (const std::size_t i : sorted) add(i, 0);
  const std::size_t there = hull.size() - 1;
  for (std::size_t k = sorted.size() - 1; k-- > 0;) add(sorted[k], there);
  hull.pop_back();
  return hull;
}

Outline::Outline(const std::vector<Feature>& points, const Order& order) {
  // About the first corner, then about the centre: small numbers keep their digits.
  Corners corners;
  corners.reserve(order.size());
  const ImagePoint& origin = points[order.front()].at;
  for (const std::size_t i : order) {
    corners.emplace_back(points[i].at.x - origin.x, points[i].at.y - origin.y);
  }
  const Moments first = polygon_moments(corners, 1);
  const Eigen::Vector2d shift(first[1][0] / first[0][0], first[0][1] / first[0][0]);
  for (Eigen::Vector2d& corner : corners) corner -= shift;
  centre_ = shift + Eigen::Vector2d(origin.x, origin.y);
  mu_ = polygon_moments(corners, 4);
  if (mu_[0][0] < 0) {
    for (auto& row : mu_) {
      for (double& m : row) m = -m;
    }
  }
  area_ = mu_[0][0];
}

PlaneDepth plane_depth(const std::vector<Feature>& points) {
  Eigen::Matrix3d N = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  const ImagePoint& origin = points.front().at;  // about a point: better conditioned far from 0
  for (const Feature& f : points) {
    const Eigen::Vector3d row(f.at.x - origin.x, f.at.y - origin.y, 1);
    N += row * row.transpose();
    b += row / f.depth_m;
  }
  const Eigen::Vector3d h = N.ldlt().solve(b);
  return {h[0], h[1], h[2] - h[0] * origin.x - h[1] * origin.y};
}

}  // namespace kestrel::laws

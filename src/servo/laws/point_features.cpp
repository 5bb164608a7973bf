#include "point_features.hpp"

#include <cmath>

namespace kestrel::laws {

Eigen::VectorXd stacked(const std::vector<Feature>& points) {
  Eigen::VectorXd s(2 * Eigen::Index(points.size()));
  Eigen::Index row = 0;
  for (const Feature& f : points) {
    s[row++] = f.at.x;
    s[row++] = f.at.y;
  }
  return s;
}

Eigen::VectorXd point_error(const LawInput& input) {
  return stacked(input.measured) - stacked(input.desired);
}

TaskJacobian point_matrix(const std::vector<Feature>& points) {
  TaskJacobian L(2 * Eigen::Index(points.size()), 6);
  Eigen::Index row = 0;
  for (const Feature& f : points) {
    const double x = f.at.x;
    const double y = f.at.y;
    const double inverse_depth = 1 / f.depth_m;
    L.row(row++) << -inverse_depth, 0, x * inverse_depth, x * y, -(1 + x * x), y;
    L.row(row++) << 0, -inverse_depth, y * inverse_depth, 1 + y * y, -x * y, -x;
  }
  return L;
}

double polygon_area(const std::vector<Feature>& points) {
  double twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ImagePoint& a = points[i].at;
    const ImagePoint& b = points[(i + 1) % points.size()].at;
    twice += a.x * b.y - b.x * a.y;
  }
  return std::abs(twice) / 2;
}

double mean_depth(const std::vector<Feature>& points) {
  double sum_m = 0;
  for (const Feature& f : points) sum_m += f.depth_m;
  return sum_m / double(points.size());
}

bool on_a_line(const std::vector<Feature>& points, double share) {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (const Feature& f : points) centre += Eigen::Vector2d(f.at.x, f.at.y);
  centre /= double(points.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const Feature& f : points) {
    const Eigen::Vector2d d = Eigen::Vector2d(f.at.x, f.at.y) - centre;
    scatter += d * d.transpose();
  }
  // The smaller eigenvalue as determinant over the larger one.
  const double half = scatter.trace() / 2;
  const double larger = half + std::hypot((scatter(0, 0) - scatter(1, 1)) / 2, scatter(0, 1));
  return !(scatter.determinant() > share * share * larger * larger);
}

}  // namespace kestrel::laws

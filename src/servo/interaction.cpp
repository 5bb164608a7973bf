#include "kestrel/servo/interaction.hpp"

#include <algorithm>
#include <stdexcept>

#include "visp_point.hpp"

namespace kestrel {

bool are_usable(const std::vector<Feature>& features) {
  return is_finite(features) &&
         std::all_of(features.begin(), features.end(),
                     [](const Feature& f) { return f.depth_m >= kSmallestDepthM; });
}

vpFeaturePoint visp_point(const Feature& feature) {
  vpFeaturePoint point;
  point.buildFrom(feature.at.x, feature.at.y, feature.depth_m);
  return point;
}

Eigen::MatrixXd interaction_matrix(const std::vector<Feature>& features) {
  if (!are_usable(features)) {
    throw std::invalid_argument("interaction matrix: points must be finite and before the camera");
  }
  Eigen::MatrixXd L(2 * features.size(), 6);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const vpMatrix rows = visp_point(features[i]).interaction();
    L.middleRows<2>(Eigen::Index(2 * i)) =
        Eigen::Map<const Eigen::Matrix<double, 2, 6, Eigen::RowMajor>>(rows.data);
  }
  return L;
}

}  // namespace kestrel

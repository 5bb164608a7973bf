#include "kestrel/servo/interaction.hpp"

#include <stdexcept>

#include "visp_point.hpp"

namespace kestrel {

Eigen::MatrixXd interaction_matrix(const std::vector<Feature>& features) {
  if (!are_usable(features)) {
    throw std::invalid_argument(
        "interaction matrix: a point is not finite, or not in front of the camera");
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

#include "heading_hold.hpp"

#include <cmath>

#include <Eigen/QR>

#include "kestrel/servo/interaction.hpp"
#include "kestrel/servo/latency.hpp"

namespace kestrel::laws {
namespace {

using Points = std::vector<Feature>;

Points with_goal_depths(const LawInput& input) {
  Points seen = input.measured;
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i].depth_m = input.desired[i].depth_m;
  return seen;
}

/// The measured points; a depth that is not known, which not all laws need, is that of the goal.
Points with_known_depths(const LawInput& input) {
  Points seen = input.measured;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!(seen[i].depth_m >= 1e-6 && std::isfinite(seen[i].depth_m)))
      seen[i].depth_m = input.desired[i].depth_m;
  }
  return seen;
}

/// L^ of the law, or what stands in for it.
Eigen::MatrixXd matrix_of(Law law, const LawInput& input) {
  switch (law) {
    case Law::Des:
      return interaction_matrix(input.desired);
    case Law::CurZdes:
      return interaction_matrix(with_goal_depths(input));
    case Law::CurZarea:
      return interaction_matrix(with_area_depth(input.measured, input.desired));
    case Law::Mean:
    case Law::Mjp:
      return (interaction_matrix(with_known_depths(input)) + interaction_matrix(input.desired)) / 2;
    case Law::MeanZdes:
      return (interaction_matrix(with_goal_depths(input)) + interaction_matrix(input.desired)) / 2;
    default:
      return interaction_matrix(with_known_depths(input));
  }
}

bool knows_rotation(Law law) {
  return law == Law::TwoAndHalfD || law == Law::PbvsCt || law == Law::PbvsCo || law == Law::Screw;
}

}  // namespace

TwistBasis body_basis(const Mount& body_from_camera, int columns) {
  const Transform<frame::Camera, frame::Body> camera_from_body = body_from_camera.inverse();
  const Matrix6d cVb = twist_matrix(camera_from_body.rotation, camera_from_body.translation);
  TwistBasis basis(6, columns);
  basis.leftCols<3>() = cVb.leftCols<3>();
  if (columns == 4) basis.col(3) = cVb.col(5);
  return basis;
}

Eigen::Vector3d against_turn(Law law, const LawInput& input, const Mount& body_from_camera,
                             double turn_rad_s) {
  if (knows_rotation(law) || turn_rad_s == 0) return Eigen::Vector3d::Zero();
  const Eigen::MatrixXd A = matrix_of(law, input) * body_basis(body_from_camera, 4);
  return -A.leftCols<3>().colPivHouseholderQr().solve(A.col(3) * turn_rad_s);
}

}  // namespace kestrel::laws

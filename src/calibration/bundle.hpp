#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "kestrel/calibration/camera_solver.hpp"
#include "kestrel/geometry/twist.hpp"

namespace kestrel {

/// What is given: views of points of one board.
struct BundleProblem {
  CameraModel model = CameraModel::None;
  std::vector<BoardView> views;
  std::vector<Eigen::Vector3d> points;  // of the board, m
  ImageSize size;
};

/// What is looked for.
struct BundleState {
  std::vector<double> values;     // of the model, as values_of
  std::vector<TargetPose> poses;  // of the board in the camera, one a view
};

/// The least squares.
struct BundleFit {
  BundleState state;
  double sum_px2 = 0;
  /// Inverse of the normal matrix of the values, poses eliminated; empty when it is singular.
  Eigen::MatrixXd inverse;
};

struct ViewBlocks;

/// A sum of squares over values and poses, px^2 (not finite where a point is put nowhere), and its
/// normal equations, one a view.
struct BundleTerms {
  std::function<double(const BundleState&)> sum_px2;
  std::function<std::optional<std::vector<ViewBlocks>>(const BundleState&)> blocks;
};

/// The minimum at the start, by Levenberg and Marquardt; empty when the sum is not finite there.
std::optional<BundleFit> minimum(const BundleTerms& terms, const BundleState& start);

/// The minimum of the pixels' least squares; empty when the start puts a point behind the camera or
/// beyond the lens.
std::optional<BundleFit> bundle(const BundleProblem& problem, const BundleState& start);

/// The pose of a view under this camera, in the least squares of the pixels, and those; empty when
/// there is none.
std::optional<TargetPose> board_pose(const BoardView& view,
                                     const std::vector<Eigen::Vector3d>& points,
                                     const Camera& camera);

/// Where the points are put less where they were seen; empty when one is put nowhere.
std::optional<std::vector<PointResidual>> residuals(const BoardView& view,
                                                    const std::vector<Eigen::Vector3d>& points,
                                                    const Camera& camera, const TargetPose& pose);

}  // namespace kestrel

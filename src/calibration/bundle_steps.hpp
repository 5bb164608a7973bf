#pragma once

#include <optional>
#include <vector>

#include "bundle.hpp"

/// The steps of the bundle: normal equations, and what follows from them.
namespace kestrel {

/// The normal equations of one view: J^T J and J^T r in blocks of values and pose.
struct ViewBlocks {
  Eigen::MatrixXd A;  // values x values
  Eigen::MatrixXd B;  // values x pose
  Matrix6d C = Matrix6d::Zero();
  Eigen::VectorXd a;
  Vector6d c = Vector6d::Zero();
};

/// Those of no measurement, of so many values.
ViewBlocks no_blocks(Eigen::Index values);

/// Adds a measurement: what it leaves over, and its derivatives by the values and the pose.
template <class Values, class Pose, class Residual>
void add(ViewBlocks& sum, const Values& J, const Pose& J_pose, const Residual& r) {
  sum.A.noalias() += J.transpose() * J;
  sum.B.noalias() += J.transpose() * J_pose;
  sum.C.noalias() += J_pose.transpose() * J_pose;
  sum.a.noalias() += J.transpose() * r;
  sum.c.noalias() += J_pose.transpose() * r;
}

/// Cameras with one value a little larger and smaller. Projections are linear in every value, so
/// their difference over the step is the derivative to rounding.
struct Neighbours {
  std::vector<Camera> above;
  std::vector<Camera> below;
  std::vector<double> distance;
};

/// The normal equations of all views, damped, and the poses eliminated: S x = s.
struct Reduced {
  Eigen::MatrixXd S;
  Eigen::VectorXd s;
};

/// The camera of these values; empty when there is none such.
std::optional<Camera> camera_of(const BundleProblem& problem, const std::vector<double>& values);

/// Where the pinhole sees a point of the camera frame, on the normalised plane.
ImagePoint projected(const Eigen::Vector3d& p);

/// The normal equations of a view; without neighbours those of its pose alone.
ViewBlocks blocks(const BoardView& view, const std::vector<Eigen::Vector3d>& points,
                  const Camera& camera, const Neighbours& near, const TargetPose& pose);

/// Those of every view; empty when there is no such camera.
std::optional<std::vector<ViewBlocks>> all_blocks(const BundleProblem& problem,
                                                  const BundleState& state);

Reduced reduced(const std::vector<ViewBlocks>& views, double damping);

/// A pose after a small motion (v, w) of the board in the camera.
TargetPose moved(const TargetPose& pose, const Vector6d& step);

/// The state after the step that the damped equations ask for.
BundleState stepped(const BundleState& state, const std::vector<ViewBlocks>& views, double damping);

}  // namespace kestrel

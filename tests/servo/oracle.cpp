#include "servo/oracle.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace kestrel::test {

MatrixXr oracle_interaction(const std::vector<Feature>& points) {
  MatrixXr L(2 * points.size(), 6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Real x = points[i].at.x;
    const Real y = points[i].at.y;
    const Real Z = points[i].depth_m;
    L.row(Eigen::Index(2 * i)) << -1 / Z, 0, x / Z, x * y, -(1 + x * x), y;
    L.row(Eigen::Index(2 * i + 1)) << 0, -1 / Z, y / Z, 1 + y * y, -x * y, -x;
  }
  return L;
}

MatrixXr oracle_twist_matrix(const Mount& body_from_camera) {
  const Matrix3r axes = body_from_camera.rotation.cast<Real>().transpose();
  const Vector3r p = body_from_camera.translation.cast<Real>();
  MatrixXr V = MatrixXr::Zero(6, 6);
  for (int i = 0; i < 3; ++i) {
    const Vector3r unit = Vector3r::Unit(i);
    V.block<3, 1>(0, i) = axes * unit;
    V.block<3, 1>(0, 3 + i) = axes * unit.cross(p);
    V.block<3, 1>(3, 3 + i) = axes * unit;
  }
  return V;
}

std::vector<int> oracle_rows(Freedom freedom) {
  if (freedom == Freedom::Six) return {0, 1, 2, 3, 4, 5};
  if (freedom == Freedom::Four) return {0, 1, 2, 5};
  return {0, 1, 2};
}

MatrixXr oracle_basis(const Mount& body_from_camera, Freedom freedom) {
  const MatrixXr V = oracle_twist_matrix(body_from_camera);
  const std::vector<int> rows = oracle_rows(freedom);
  MatrixXr basis(6, rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) basis.col(Eigen::Index(i)) = V.col(rows[i]);
  return basis;
}

OracleAnswer oracle_servo(const std::vector<Feature>& measured, const std::vector<Feature>& desired,
                          const Mount& body_from_camera, const ServoOptions& options) {
  const MatrixXr now = oracle_interaction(measured);
  const MatrixXr goal = oracle_interaction(desired);
  MatrixXr L = (now + goal) / 2;
  if (options.law == Law::Cur) L = now;
  if (options.law == Law::Des) L = goal;
  VectorXr e(2 * measured.size());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    e[Eigen::Index(2 * i)] = Real(measured[i].at.x) - Real(desired[i].at.x);
    e[Eigen::Index(2 * i + 1)] = Real(measured[i].at.y) - Real(desired[i].at.y);
  }
  const MatrixXr B = oracle_basis(body_from_camera, options.freedom);
  const MatrixXr J = L * B;
  const VectorXr u = solved(J, -Real(options.gain_per_s) * e);
  const VectorXr values = singular_values(J);
  return {(B * u).cast<double>(), double(values[0] / values[values.size() - 1])};
}

Eigen::VectorXd stacked(const std::vector<Feature>& points) {
  Eigen::VectorXd s(2 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    s[Eigen::Index(2 * i)] = points[i].at.x;
    s[Eigen::Index(2 * i + 1)] = points[i].at.y;
  }
  return s;
}

std::array<Eigen::Vector3d, 4> square(double half) {
  return {{{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}}};
}

TargetPose pose_of(const Eigen::Vector3d& t, const Eigen::Vector3d& theta_u_deg) {
  return {rotation_from_vector(theta_u_deg * M_PI / 180), t};
}

Mount forward_mount(const Eigen::Vector3d& at) {
  return {(Eigen::Matrix3d() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished(), at};
}

Mount down_mount(const Eigen::Vector3d& at) {
  return {(Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished(), at};
}

VectorXr solved(const MatrixXr& J, const VectorXr& e) { return J.colPivHouseholderQr().solve(e); }

VectorXr singular_values(const MatrixXr& M) {
  return Eigen::JacobiSVD<MatrixXr>(M).singularValues();
}

Eigen::VectorXd singular_values(const Eigen::MatrixXd& M) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(M).singularValues();
}

Eigen::VectorXd solved(const Eigen::MatrixXd& M, const Eigen::VectorXd& e, double tolerance) {
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(M, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(tolerance);
  return svd.solve(e);
}

Eigen::VectorXd modes(const Eigen::MatrixXd& M) {
  Eigen::VectorXd real = M.eigenvalues().real();
  std::sort(real.begin(), real.end());
  return real;
}

}  // namespace kestrel::test

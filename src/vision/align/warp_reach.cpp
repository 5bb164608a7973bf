#include "warp_reach.hpp"

#include <algorithm>

#include <Eigen/LU>

namespace kestrel {

double reach(const Eigen::Matrix3d& W, const Eigen::Matrix3d& scaled,
             const TemplateBlocks& blocks) {
  double farthest = 0;
  for (const Pixel& corner : template_corners(blocks.width, blocks.height)) {
    const Eigen::Vector3d p = scaled * Eigen::Vector3d(corner.u, corner.v, 1);
    const Eigen::Vector3d q = W * p;
    farthest = std::max(farthest, (q.head<2>() / q.z() - p.head<2>()).norm());
  }
  return farthest;
}

Matrix8d corner_derivatives(const Homography& H, const Eigen::Matrix3d& scaled,
                            const TemplateBlocks& blocks) {
  const Eigen::Matrix3d G = H.H * scaled.inverse();
  Matrix8d J;
  int row = 0;
  for (const Pixel& corner : template_corners(blocks.width, blocks.height)) {
    const Eigen::Vector3d p = scaled * Eigen::Vector3d(corner.u, corner.v, 1);
    const double x = p.x();
    const double y = p.y();
    Eigen::Matrix<double, 2, 8> motion;           // of the point, by the parameters of warp()
    motion << 1, 0, x, -y, x, y, -x * x, -x * y,  //
        0, 1, y, x, -y, x, -x * y, -y * y;
    const Eigen::Vector3d q = G * p;
    Eigen::Matrix2d D;  // of the image point by the point
    D << G(0, 0) - G(2, 0) * q.x() / q.z(), G(0, 1) - G(2, 1) * q.x() / q.z(),
        G(1, 0) - G(2, 0) * q.y() / q.z(), G(1, 1) - G(2, 1) * q.y() / q.z();
    J.middleRows<2>(row) = D * motion / q.z();
    row += 2;
  }
  return J;
}

}  // namespace kestrel

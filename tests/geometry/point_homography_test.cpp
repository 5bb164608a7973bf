#include "kestrel/geometry/point_homography.hpp"

#include <limits>

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "kestrel/geometry/rotation.hpp"

#include "support/random.hpp"

namespace kestrel {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const double kNan = std::numeric_limits<double>::quiet_NaN();

/// Two views of a plane n.p = d of the first camera.
struct TwoViews {
  Matrix3d R;  // b from a
  Vector3d t;
  Vector3d n;
  double d = 0;
  std::vector<ImagePoint> a, b;
  std::vector<double> depth_ratio;  // depth in b over depth in a

  Matrix3d homography() const { return R + t * n.transpose() / d; }
};

TwoViews any_views(test::Random& random, int count) {
  TwoViews v;
  v.R = rotation_from_vector(random.rotation_vector(0.4));
  v.t = random.vector3(0.4);
  v.n = rotation_from_vector(random.rotation_vector(0.5)) * Vector3d::UnitZ();
  v.d = random.uniform(1.5, 4);
  for (int i = 0; i < count; ++i) {
    const double s = i % 2 == 0 ? 0.3 : -0.3;
    const double r = i / 2 % 2 == 0 ? 0.3 : -0.3;
    const Vector3d m(s + random.uniform(-.1, .1), r + random.uniform(-.1, .1), 1);
    const Vector3d p = v.d / v.n.dot(m) * m;
    const Vector3d q = v.R * p + v.t;
    v.a.push_back({m.x(), m.y()});
    v.b.push_back({q.x() / q.z(), q.y() / q.z()});
    v.depth_ratio.push_back(q.z() / p.z());
  }
  return v;
}

TEST(PointHomography, IsRotationPlusTranslationOverDistance) {
  test::Random random("point homography");
  for (int i = 0; i < 100; ++i) {
    const TwoViews v = any_views(random, i % 2 == 0 ? 4 : 9);
    const auto H = point_homography(v.a, v.b);
    ASSERT_TRUE(H);
    EXPECT_LT((*H - v.homography()).norm(), 1e-12);
  }
}

// Whatever the scale and sign it comes in: the third row tells the ratio of the depths.
TEST(PointHomography, EuclideanScaleGivesTheDepthRatios) {
  test::Random random("euclidean");
  for (const double scale : {1.0, -1.0, 3.7, -1e-5, 1e6}) {
    const TwoViews v = any_views(random, 4);
    const auto H = euclidean_homography(scale * v.homography(), v.a);
    ASSERT_TRUE(H);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(H->row(2).dot(Vector3d(v.a[i].x, v.a[i].y, 1)), v.depth_ratio[i], 1e-13);
    }
  }
}

// Half a turn about the optical axis and a camera that has come very close.
TEST(PointHomography, OfLargeMotions) {
  const std::vector<ImagePoint> a{{-.2, -.1}, {.2, -.1}, {.2, .3}, {-.2, .3}};
  std::vector<ImagePoint> b;
  for (const ImagePoint& p : a) b.push_back({-10 * p.x, -10 * p.y});
  const Matrix3d expected = Vector3d(-1, -1, 0.1).asDiagonal();
  const auto H = point_homography(a, b);
  ASSERT_TRUE(H);
  EXPECT_LT((*H - expected).norm(), 1e-13);
}

TEST(PointHomography, IsEmptyWhereThereIsNone) {
  const std::vector<ImagePoint> a{{-.2, -.1}, {.2, -.1}, {.2, .3}, {-.2, .3}};
  EXPECT_FALSE(point_homography({}, {}));
  EXPECT_FALSE(point_homography({a[0], a[1], a[2]}, {a[0], a[1], a[2]}));
  EXPECT_FALSE(point_homography(a, {a[0], a[1], a[2]}));
  EXPECT_FALSE(point_homography(a, {a[0], a[1], {0, -.1}, a[3]}));  // three on a line
  EXPECT_FALSE(point_homography(a, {a[0], a[1], a[2], {kNan, 0}}));
  EXPECT_FALSE(euclidean_homography(Matrix3d::Zero(), a));
  EXPECT_FALSE(euclidean_homography(Matrix3d::Constant(kNan), a));
  EXPECT_FALSE(euclidean_homography(Matrix3d::Identity(), {}));
  EXPECT_FALSE(euclidean_homography(Vector3d(1, 1, 0).asDiagonal(), a));  // plane seen edge-on
  Matrix3d across = Matrix3d::Identity();
  across(2, 0) = 10;  // some points in front, some behind
  EXPECT_FALSE(euclidean_homography(across, a));
}

}  // namespace
}  // namespace kestrel

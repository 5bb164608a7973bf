#include "kestrel/geometry/point_pose.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "kestrel/geometry/twist.hpp"

#include "support/random.hpp"

namespace kestrel {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

const double kNan = std::numeric_limits<double>::quiet_NaN();
const Points kSquare{{-.1, -.1, 0}, {.1, -.1, 0}, {.1, .1, 0}, {-.1, .1, 0}};
const Points kBox{{-.1, -.1, 0},   {.1, -.1, .1}, {.1, .1, 0},
                  {-.1, .1, -.05}, {0, .05, .1},  {.05, 0, -.1}};

std::vector<ImagePoint> seen_from(const TargetPose& pose, const Points& points) {
  std::vector<ImagePoint> seen;
  for (const Vector3d& point : points) {
    const Vector3d p = pose * point;
    seen.push_back({p.x() / p.z(), p.y() / p.z()});
  }
  return seen;
}

TargetPose any_pose(test::Random& random) {
  return {rotation_from_vector(random.rotation_vector(0.9)) *
              rotation_from_vector({0, 0, random.uniform(-3, 3)}),
          random.vector3(0.3) + Vector3d(0, 0, random.uniform(0.8, 4))};
}

double gap(const TargetPose& a, const TargetPose& b) {
  return (a.rotation - b.rotation).norm() + (a.translation - b.translation).norm();
}

Points placed(const Points& points, const Matrix3d& R, const Vector3d& t) {
  Points moved_points;
  for (const Vector3d& p : points) moved_points.push_back(R * p + t);
  return moved_points;
}

double squared_error(const TargetPose& pose, const Points& points,
                     const std::vector<ImagePoint>& seen) {
  const auto again = seen_from(pose, points);
  double sum = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    sum += std::pow(again[i].x - seen[i].x, 2) + std::pow(again[i].y - seen[i].y, 2);
  }
  return sum;
}

// Rounding of the image, 1e-16, times how little the square tells of its tilt (condition of the
// interaction matrix at 4 m: some 1e4).
TEST(PointPose, InvertsTheProjectionOfASquare) {
  test::Random random("point pose");
  for (int i = 0; i < 200; ++i) {
    const TargetPose pose = any_pose(random);
    const auto found = point_pose(kSquare, seen_from(pose, kSquare));
    ASSERT_TRUE(found);
    EXPECT_LT(gap(*found, pose), 1e-11);
    EXPECT_LT(rotation_defect(found->rotation), 1e-14);
  }
}

TEST(PointPose, InvertsTheProjectionOfAnyPlane) {
  test::Random random("any plane");
  const Points five{{-.1, -.1, 0}, {.1, -.1, 0}, {.1, .2, 0}, {-.1, .1, 0}, {.02, .01, 0}};
  for (int i = 0; i < 100; ++i) {
    const Matrix3d R = rotation_from_vector(random.rotation_vector(3));
    const Vector3d t = random.vector3(0.5);
    const Points points = placed(five, R, t);
    const TargetPose plane = any_pose(random);
    const TargetPose pose{plane.rotation * R.transpose(),
                          plane.translation - plane.rotation * R.transpose() * t};
    const auto found = point_pose(points, seen_from(pose, points));
    ASSERT_TRUE(found);
    EXPECT_LT(gap(*found, pose), 1e-11);
  }
}

TEST(PointPose, InvertsTheProjectionOfPointsInSpace) {
  test::Random random("space");
  for (int i = 0; i < 100; ++i) {
    const TargetPose pose = any_pose(random);
    const auto found = point_pose(kBox, seen_from(pose, kBox));
    ASSERT_TRUE(found);
    EXPECT_LT(gap(*found, pose), 1e-11);
  }
}

// Three points have up to four poses: the one near the previous is meant.
TEST(PointPose, FollowsThePreviousPose) {
  test::Random random("previous");
  const Points three{kBox[0], kBox[1], kBox[3]};
  for (int i = 0; i < 50; ++i) {
    const TargetPose pose = any_pose(random);
    const Displacement step = exponential(
        (Vector6d() << random.vector3(.005), random.rotation_vector(.01)).finished(), 1);
    const TargetPose previous{step.rotation * pose.rotation,
                              step.rotation * pose.translation + step.translation};
    for (const Points& points : {kSquare, kBox, three}) {
      const auto found = point_pose(points, seen_from(pose, points), previous);
      ASSERT_TRUE(found);
      EXPECT_LT(gap(*found, pose), points.size() == 3 ? 1e-9 : 1e-11);
    }
  }
}

TEST(PointPose, FindsItWhenThePreviousIsOfNoUse) {
  const TargetPose pose{rotation_from_vector({.2, .1, -2}), {.05, .1, .9}};
  const TargetPose behind{Matrix3d::Identity(), {0, 0, -1}};
  const TargetPose nan{Matrix3d::Constant(kNan), {0, 0, 1}};
  for (const TargetPose& previous : {behind, nan}) {
    const auto found = point_pose(kSquare, seen_from(pose, kSquare), previous);
    ASSERT_TRUE(found);
    EXPECT_LT(gap(*found, pose), 1e-12);
  }
}

// With noise no pose near the answer sees the points nearer to where they were seen.
TEST(PointPose, IsTheLeastSquaresOfTheImage) {
  test::Random random("noise");
  for (int i = 0; i < 30; ++i) {
    const TargetPose pose{rotation_from_vector(random.rotation_vector(0.6)), {0.1, 0, 0.9}};
    auto seen = seen_from(pose, kSquare);
    for (ImagePoint& p : seen) p = {p.x + random.normal() / 600, p.y + random.normal() / 600};
    const auto found = point_pose(kSquare, seen);
    ASSERT_TRUE(found);
    const double least = squared_error(*found, kSquare, seen);
    for (int k = 0; k < 12; ++k) {
      const Vector6d nudge = (k % 2 == 0 ? 1e-4 : -1e-4) * Vector6d::Unit(k / 2);
      const Displacement step = exponential(nudge, 1);
      const TargetPose other{step.rotation * found->rotation,
                             step.rotation * found->translation + step.translation};
      EXPECT_GT(squared_error(other, kSquare, seen), least);
    }
  }
}

TEST(PointPose, IsEmptyWhereThereIsNone) {
  const TargetPose pose{Matrix3d::Identity(), {0, 0, 1}};
  const auto seen = seen_from(pose, kSquare);
  EXPECT_FALSE(point_pose({}, {}));
  EXPECT_FALSE(point_pose(kSquare, {seen[0], seen[1], seen[2]}));
  const Points three{kSquare[0], kSquare[1], kSquare[2]};
  EXPECT_FALSE(point_pose(three, {seen[0], seen[1], seen[2]}));
  const Points line{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}};
  EXPECT_FALSE(point_pose(line, seen, pose));
  EXPECT_FALSE(point_pose({kBox[0], kBox[1], kBox[2], kBox[4]}, seen));  // in space, too few
  EXPECT_FALSE(point_pose(kSquare, {seen[0], seen[1], seen[2], {kNan, 0}}));
  EXPECT_FALSE(point_pose(kSquare, {seen[0], seen[0], seen[0], seen[0]}));
  EXPECT_FALSE(point_pose({{kNan, 0, 0}, kSquare[1], kSquare[2], kSquare[3]}, seen, pose));
}

}  // namespace
}  // namespace kestrel

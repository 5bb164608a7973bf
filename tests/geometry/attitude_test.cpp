#include "kestrel/geometry/attitude.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"

#include "support/random.hpp"

namespace kestrel {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d forward_mount() {
  Matrix3d body_R_camera;
  body_R_camera << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return body_R_camera;
}

// Gravity is known in both frames: down in the level frame, and by trigonometry in the body
// (nose up: down leans towards the tail).
TEST(Attitude, LevelFrameSeesGravityStraightDown) {
  test::Random random("level");
  for (int i = 0; i < 100; ++i) {
    const Attitude a{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-3, 3)};
    const Vector3d down_in_body(-std::sin(a.pitch), std::cos(a.pitch) * std::sin(a.roll),
                                std::cos(a.pitch) * std::cos(a.roll));
    EXPECT_LT((level_from_body(a) * down_in_body - Vector3d::UnitZ()).norm(), 1e-14);
  }
}

TEST(Attitude, LevellingKeepsTheHeading) {
  test::Random random("heading");
  for (int i = 0; i < 100; ++i) {
    const Attitude a{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-3, 3)};
    const Vector3d forward = level_from_body(a) * Vector3d::UnitX();
    EXPECT_NEAR(forward.y(), 0, 1e-14);
    EXPECT_GT(forward.x(), 0);
    const Matrix3d ned_from_level = rotation_from_vector({0, 0, a.yaw});
    EXPECT_LT(
        (ned_from_level * level_from_body(a) - rotation_from_rpy(a.roll, a.pitch, a.yaw)).norm(),
        1e-14);
  }
}

// What a forward camera sees when the nose goes up: the horizon moves down in the image, and the
// level camera has it back at the height of the axis.
TEST(Attitude, NoseUpIsTakenOutOfAForwardCamera) {
  const double pitch = 0.2;
  const Vector3d horizon(0, std::tan(pitch), 1);  // below the axis: y is down
  const Vector3d level = level_camera_from_camera(forward_mount(), {0, pitch, 0}) * horizon;
  EXPECT_NEAR(level.y(), 0, 1e-15);
  EXPECT_NEAR(level.x(), 0, 1e-15);
  EXPECT_GT(level.z(), 1);
}

// Right side down: the horizon's right half rises in the image.
TEST(Attitude, RollIsTakenOutOfAForwardCamera) {
  const double roll = 0.3;
  const Vector3d horizon(std::cos(roll), -std::sin(roll), 1);
  const Vector3d level = level_camera_from_camera(forward_mount(), {roll, 0, 0}) * horizon;
  EXPECT_LT((level - Vector3d(1, 0, 1)).norm(), 1e-15);
}

TEST(Attitude, YawAndLevelFlightChangeNothing) {
  test::Random random("no tilt");
  const Matrix3d mount = rotation_from_vector(random.rotation_vector(M_PI));
  EXPECT_LT((level_camera_from_camera(mount, {0, 0, 1.7}) - Matrix3d::Identity()).norm(), 1e-14);
}

// The level camera is bolted to the level helicopter as the camera is to the tilted one.
TEST(Attitude, LevelCameraIsMountedOnTheLevelBody) {
  test::Random random("level camera");
  for (int i = 0; i < 50; ++i) {
    const Matrix3d mount = rotation_from_vector(random.rotation_vector(M_PI));
    const Attitude a{random.uniform(-1, 1), random.uniform(-1, 1), 0};
    const Vector3d m = random.vector3(2);
    const Vector3d in_level_by_body = level_from_body(a) * (mount * m);
    const Vector3d in_level_by_camera = mount * (level_camera_from_camera(mount, a) * m);
    EXPECT_LT((in_level_by_body - in_level_by_camera).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace kestrel

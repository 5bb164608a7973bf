#include "kestrel/geometry/transform.hpp"

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

// A few products of numbers up to 10: rounding stays below this.
constexpr double kRounding = 1e-13;

template <class To, class From>
Transform<To, From> any(test::Random& random) {
  return {rotation_from_vector(random.rotation_vector(M_PI)), random.vector3(10)};
}

TEST(Transform, InverseUndoesIt) {
  test::Random random("transform inverse");
  for (int i = 0; i < 100; ++i) {
    const auto pose = any<frame::Camera, frame::Target>(random);
    const Eigen::Vector3d p = random.vector3(10);
    EXPECT_LT((pose.inverse() * (pose * p) - p).norm(), kRounding);
    const Transform<frame::Target, frame::Target> none = pose.inverse() * pose;
    EXPECT_LT((none.rotation - Eigen::Matrix3d::Identity()).norm(), kRounding);
    EXPECT_LT(none.translation.norm(), kRounding);
  }
}

TEST(Transform, CompositionActsAsOneAfterTheOther) {
  test::Random random("transform composition");
  for (int i = 0; i < 100; ++i) {
    const auto body_from_camera = any<frame::Body, frame::Camera>(random);
    const auto camera_from_target = any<frame::Camera, frame::Target>(random);
    const Eigen::Vector3d p = random.vector3(10);
    EXPECT_LT(
        ((body_from_camera * camera_from_target) * p - body_from_camera * (camera_from_target * p))
            .norm(),
        10 * kRounding);
  }
}

TEST(Transform, TranslationIsTheOriginOfFromInTo) {
  test::Random random("transform origin");
  const auto pose = any<frame::World, frame::Body>(random);
  const Eigen::Vector3d origin = pose * Eigen::Vector3d(0, 0, 0);
  EXPECT_EQ(origin, pose.translation);
  const Eigen::Vector3d forward = pose * Eigen::Vector3d(1, 0, 0) - origin;
  EXPECT_LT((forward - pose.rotation.col(0)).norm(), kRounding);
}

// ViSP's usual forward-looking mount, written by hand: the optical axis is the body's x.
TEST(Transform, ForwardMountTakesTheOpticalAxisForward) {
  Mount body_from_camera;
  body_from_camera.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  body_from_camera.translation = {0.3, 0, 0.1};
  EXPECT_EQ(body_from_camera * Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(2.3, 0, 0.1));
  EXPECT_EQ(body_from_camera * Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.3, 1, 0.1));
  EXPECT_EQ(body_from_camera * Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0.3, 0, 1.1));
}

}  // namespace
}  // namespace kestrel

#include "kestrel/geometry/frames.hpp"

#include <type_traits>
#include <utility>

#include <gtest/gtest.h>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/geometry/twist.hpp"

namespace kestrel {
namespace {

template <class A, class B, class = void>
inline constexpr bool kCanMultiply = false;
template <class A, class B>
inline constexpr bool
    kCanMultiply<A, B, std::void_t<decltype(std::declval<A>() * std::declval<B>())>> = true;

using BodyFromCamera = Transform<frame::Body, frame::Camera>;
using CameraFromBody = Transform<frame::Camera, frame::Body>;
using CameraFromTarget = Transform<frame::Camera, frame::Target>;
using TargetFromCamera = Transform<frame::Target, frame::Camera>;
using WorldFromBody = Transform<frame::World, frame::Body>;

// What must compile, with the type it must have.
static_assert(std::is_same_v<decltype(BodyFromCamera() * CameraTwist()), BodyTwist>);
static_assert(std::is_same_v<decltype(CameraFromBody() * BodyTwist()), CameraTwist>);
static_assert(std::is_same_v<decltype(BodyFromCamera() * CameraFromTarget()),
                             Transform<frame::Body, frame::Target>>);
static_assert(std::is_same_v<decltype(CameraFromTarget().inverse()), TargetFromCamera>);

// What flies the helicopter into the wall and must not compile.
static_assert(!kCanMultiply<BodyFromCamera, BodyTwist>, "a mount takes camera twists");
static_assert(!kCanMultiply<CameraFromBody, CameraTwist>, "the mount the wrong way round");
static_assert(!kCanMultiply<CameraFromTarget, BodyFromCamera>, "frames are not adjacent");
static_assert(!kCanMultiply<CameraFromTarget, CameraFromBody>, "frames are not adjacent");
static_assert(!kCanMultiply<CameraFromTarget, CameraTwist>, "the target does not move along");
static_assert(!kCanMultiply<TargetFromCamera, CameraTwist>, "the target does not move along");
static_assert(!kCanMultiply<WorldFromBody, BodyTwist>, "the world does not move along");
static_assert(!std::is_convertible_v<BodyTwist, CameraTwist>);
static_assert(!std::is_constructible_v<CameraTwist, BodyTwist>);
static_assert(!std::is_convertible_v<CameraFromBody, BodyFromCamera>);
static_assert(!std::is_convertible_v<Pixel, ImagePoint> &&
              !std::is_convertible_v<ImagePoint, Pixel>);
static_assert(!std::is_convertible_v<Eigen::Vector3d, CameraTwist>);

template <class A, class B>
constexpr bool symmetric() {
  return frame::kRigid<A, B> == frame::kRigid<B, A>;
}

TEST(Frames, RigidityIsSymmetricAndOnlyBetweenCameraAndBody) {
  using frame::Body;
  using frame::Camera;
  using frame::Target;
  using frame::World;
  EXPECT_TRUE((symmetric<Camera, Body>() && symmetric<Camera, Target>() &&
               symmetric<Body, World>() && symmetric<Target, World>()));
  EXPECT_TRUE((frame::kRigid<Camera, Body> && frame::kRigid<Target, Target>));
  EXPECT_FALSE((frame::kRigid<Camera, Target> || frame::kRigid<Body, Target> ||
                frame::kRigid<Camera, World> || frame::kRigid<Body, World> ||
                frame::kRigid<Target, World>));
}

}  // namespace
}  // namespace kestrel

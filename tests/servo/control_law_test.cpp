#include "kestrel/servo/control_law.hpp"

#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

constexpr double kPi = 3.14159265358979323846;

LawInput tutorial() {
  const std::array<Eigen::Vector3d, 4> square{
      {{-.1, -.1, 0}, {.1, -.1, 0}, {.1, .1, 0}, {-.1, .1, 0}}};
  const Eigen::Vector3d turn = Eigen::Vector3d(10, -10, 50) * kPi / 180;
  LawInput input;
  input.measured = features(TargetPose{rotation_from_vector(turn), {.15, -.1, 1}}, square);
  input.desired = features(TargetPose{Eigen::Matrix3d::Identity(), {0, 0, .75}}, square);
  return input;
}

TEST(ControlLaw, FirstTwistOfTheTutorial) {
  LawOptions options;
  options.law = Law::Cur;
  options.gain = LawGain::constant(1);
  const LawAnswer answer = control_law(tutorial(), options);
  ASSERT_TRUE(answer.twist);
  const Vector6d printed =
      (Vector6d() << .020066, -.089513, -.127833, .150247, .002328, 1.031707).finished();
  // Six printed digits.
  EXPECT_LT((answer.twist->vector() - printed).cwiseAbs().maxCoeff(), 1e-6);
}

}  // namespace
}  // namespace kestrel

#include <cmath>

#include <gtest/gtest.h>

#include "kestrel/servo/control_law.hpp"

#include "servo/law_bench.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

constexpr Law kLearnedLaws[] = {Law::Broyden, Law::BroydenRaw, Law::Rls};

LawState untaught(Law law) {
  return control_law(test::input_at(test::kS0), test::unit_options(law)).next;
}

/// The same view as before, a little moved, with the motion that is claimed for it.
LawInput moved_input(double size, const std::optional<Vector6d>& motion) {
  const Vector6d xi = (Vector6d() << .2, -.1, .3, .1, .2, -.3).finished() * size;
  LawInput input =
      test::input_at(moved(test::kS0.inverse(), CameraTwist::from_vector(xi), 1).inverse());
  input.camera_motion = motion;
  return input;
}

const Vector6d kMotion = (Vector6d() << .02, -.01, .03, .01, .02, -.03).finished();

TEST(LearnedLaw, BeginsWithTheDesiredMatrix) {
  for (const Law law : kLearnedLaws) {
    EXPECT_EQ(test::twist_at(test::kS0, law), test::twist_at(test::kS0, Law::Des)) << name(law);
    const LawState state = untaught(law);
    EXPECT_EQ(state.jacobian.rows(), 8);
    EXPECT_EQ(state.jacobian.cols(), 6);
  }
}

// Broyden's two laws: the secant is met, J u stays for every u across the motion.
TEST(LearnedLaw, BroydenMeetsTheSecantAndChangesNothingElse) {
  for (const Law law : {Law::Broyden, Law::BroydenRaw}) {
    const LawState before = untaught(law);
    const LawInput input = moved_input(0.1, kMotion);
    const LawState after = control_law(input, test::unit_options(law), before).next;
    const Eigen::VectorXd ds = test::stacked(input.measured) - before.features;
    ASSERT_GT(ds.norm(), 0.01);
    EXPECT_LT((after.jacobian * kMotion - ds).norm(), 1e-14);
    const Eigen::MatrixXd change = after.jacobian - before.jacobian;
    Matrix6d across = Matrix6d::Identity() - kMotion * kMotion.transpose() / kMotion.squaredNorm();
    EXPECT_GT(change.norm(), 1e-3);
    EXPECT_LT((change * across).norm(), 1e-14);
    EXPECT_EQ(after.motion, Vector6d::Zero());
    EXPECT_EQ(after.features, test::stacked(input.measured));
  }
}

// Below the gate the motion is gathered; the secant is then that of the whole way.
TEST(LearnedLaw, BroydenWaitsForTheGate) {
  const LawOptions options = test::unit_options(Law::Broyden);
  const LawState before = untaught(Law::Broyden);
  const LawState small = control_law(moved_input(0.005, kMotion / 20), options, before).next;
  EXPECT_EQ(small.jacobian, before.jacobian);
  EXPECT_EQ(small.features, before.features);
  EXPECT_EQ(small.motion, kMotion / 20);
  const LawInput whole = moved_input(0.1, Vector6d(kMotion * 19 / 20));
  const LawState after = control_law(whole, options, small).next;
  const Eigen::VectorXd ds = test::stacked(whole.measured) - before.features;
  EXPECT_LT((after.jacobian * kMotion - ds).norm(), 1e-14);
  // The raw one learns from anything.
  const LawState raw =
      control_law(moved_input(0.005, kMotion / 20), test::unit_options(Law::BroydenRaw), before)
          .next;
  EXPECT_NE(raw.jacobian, before.jacobian);
}

// Least squares with forgetting, written as one batch: sum of f^(n-i) |ds_i - J dx_i|^2 and the
// prior f^n |J - J0|^2 / P0.
TEST(LearnedLaw, RlsIsWeightedLeastSquares) {
  test::Random random("rls");
  LawOptions options = test::unit_options(Law::Rls);
  options.forgetting = 0.8;
  options.initial_covariance = 10;
  LawState state = control_law(test::input_at(test::kS0), options).next;
  Eigen::MatrixXd normal = Matrix6d::Identity() / 10;
  Eigen::MatrixXd right = state.jacobian / 10;
  TargetPose pose = test::kS0;
  for (int k = 0; k < 12; ++k) {
    Vector6d dx;
    dx << random.vector3(0.05), random.vector3(0.05);
    const Eigen::VectorXd before = test::stacked(test::input_at(pose).measured);
    pose = moved(pose.inverse(), CameraTwist::from_vector(dx), 1).inverse();
    LawInput input = test::input_at(pose);
    input.camera_motion = dx;
    state = control_law(input, options, state).next;
    normal = 0.8 * normal + dx * dx.transpose();
    right = 0.8 * right + (test::stacked(input.measured) - before) * dx.transpose();
    const Eigen::MatrixXd expected = right * normal.inverse();
    EXPECT_LT((state.jacobian - expected).norm(), 1e-10 * expected.norm()) << k;
  }
}

// Twenty random steps about a place teach the Jacobian of the place.
TEST(LearnedLaw, LearnsTheTrueMatrix) {
  test::Random random("learned");
  for (const Law law : kLearnedLaws) {
    LawOptions options = test::unit_options(law);
    options.forgetting = 1;
    options.learning_gate = 0;
    LawState state = untaught(law);
    // Motions of 1e-4 shall outweigh what was believed before.
    if (law == Law::Rls) state.covariance = 1e12 * Matrix6d::Identity();
    TargetPose pose = test::kS0;
    const Eigen::MatrixXd L =
        test::oracle_interaction(test::input_at(pose).measured).cast<double>();
    const double at_first = (state.jacobian - L).norm();
    for (int k = 0; k < 60; ++k) {
      Vector6d dx;
      dx << random.vector3(1e-4), random.vector3(1e-4);
      pose = moved(pose.inverse(), CameraTwist::from_vector(dx), 1).inverse();
      LawInput input = test::input_at(pose);
      input.camera_motion = dx;
      state = control_law(input, options, state).next;
    }
    // The place drifts by sixty steps of 1e-4: a per mille or so of L.
    EXPECT_LT((state.jacobian - L).norm(), 0.02 * at_first) << name(law);
  }
}

TEST(LearnedLaw, LearnsNothingWithoutAMotion) {
  for (const Law law : kLearnedLaws) {
    const LawOptions options = test::unit_options(law);
    const LawState before = untaught(law);
    const LawState lost = control_law(moved_input(0.1, std::nullopt), options, before).next;
    EXPECT_EQ(lost.jacobian, before.jacobian);
    EXPECT_EQ(lost.features, test::stacked(moved_input(0.1, std::nullopt).measured));
    EXPECT_EQ(lost.motion, Vector6d::Zero());
    // A target that moves before a camera that stands teaches nothing either.
    const LawState still =
        control_law(moved_input(0.1, Vector6d(Vector6d::Zero())), options, before).next;
    EXPECT_EQ(still.jacobian, before.jacobian);
    // And a refused measurement leaves the state as it was.
    LawInput broken = moved_input(0.1, kMotion);
    broken.measured[0].at.x = NAN;
    const LawAnswer refused = control_law(broken, options, before);
    EXPECT_FALSE(refused.twist);
    EXPECT_EQ(refused.next.jacobian, before.jacobian);
    EXPECT_EQ(refused.next.features, before.features);
  }
}

TEST(LearnedLaw, BeginsAgainWhenTheStateDoesNotFit) {
  for (const Law law : kLearnedLaws) {
    LawInput three = moved_input(0.1, kMotion);
    three.measured.pop_back();
    three.desired.pop_back();
    LawState broken = untaught(law);
    broken.jacobian(0, 0) = NAN;
    for (const LawState& state : {untaught(law), broken}) {
      const LawAnswer answer = control_law(three, test::unit_options(law), state);
      ASSERT_TRUE(answer.twist);
      EXPECT_EQ(answer.next.jacobian.rows(), 6);
      EXPECT_TRUE(answer.next.jacobian.allFinite());
    }
  }
}

TEST(LearnedLaw, ConvergesFromTheTutorialsStart) {
  for (const Law law : kLearnedLaws) {
    const TargetPose end = test::fly(test::kS0, test::unit_options(law), 600, 1. / 30);
    EXPECT_LT(test::error_at(end), 1e-3) << name(law);
  }
}

// At the goal nothing moves and the covariance of rls could grow for ever: eleven minutes at 30 Hz.
TEST(LearnedLaw, StaysFiniteWhileItStands) {
  const LawOptions options = test::unit_options(Law::Rls);
  LawState state = untaught(Law::Rls);
  const LawInput input = moved_input(0.1, Vector6d(Vector6d::Unit(0) * 1e-6));
  for (int k = 0; k < 20000; ++k) state = control_law(input, options, state).next;
  const LawAnswer answer = control_law(input, options, state);
  EXPECT_TRUE(answer.twist);
  EXPECT_TRUE(answer.next.covariance.allFinite());
}

}  // namespace
}  // namespace kestrel

// pbvs_ct, pbvs_co, screw and 2.5d: the laws that look at a pose.
#include <limits>

#include <gtest/gtest.h>

#include "servo/law_rates.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

using Eigen::Vector3d;

constexpr Law kPoseLaws[] = {Law::PbvsCt, Law::PbvsCo, Law::Screw, Law::TwoAndHalfD};

TEST(PoseLaws, FirstTwistOfTheTutorial) {
  const Vector6d printed =
      (Vector6d() << .210373, .066987, .271323, .174533, -.174533, .872665).finished();
  EXPECT_LT((test::twist_at(test::kS0, Law::PbvsCt) - printed).cwiseAbs().maxCoeff(), 1e-6);
}

// de/dt = -gain e with the interaction matrix that differences find: all four linearise exactly.
TEST(PoseLaws, MakeTheirErrorDecayAtTheGain) {
  test::Random random("pose laws");
  for (const Law law : kPoseLaws) {
    for (int i = 0; i < 30; ++i) {
      const TargetPose pose = test::any_view(random, 1.8, 0.8);
      const LawAnswer answer = control_law(test::input_at(pose), test::unit_options(law));
      ASSERT_TRUE(answer.twist) << name(law);
      const Eigen::MatrixXd L = test::error_rate(pose, law);
      EXPECT_LT((L * answer.twist->vector() + answer.error).norm(), 1e-8) << name(law);
      EXPECT_LT((test::singular_values(L) - answer.singular_values).norm(), 1e-7) << name(law);
      EXPECT_EQ(answer.rank, 6);
      EXPECT_NEAR(answer.condition, answer.singular_values[0] / answer.singular_values[5], 1e-12);
    }
  }
}

/// Largest distance of points from the line through the first and the last.
double bow(const std::vector<Vector3d>& path) {
  const Vector3d along = (path.back() - path.front()).normalized();
  double largest = 0;
  for (const Vector3d& p : path) {
    largest = std::max(largest, along.cross(p - path.front()).norm());
  }
  return largest;
}

// A twist held for 1/300 s bends the path by half of w dt: 1 rad/s over 0.35 m, 6e-4 m. The other
// laws' paths bow by centimetres.
TEST(PoseLaws, StraightPaths) {
  const auto bow_of = [](Law law, bool of_camera) {
    std::vector<Vector3d> path;
    test::fly(test::kS0, test::unit_options(law), 1500, 1.0 / 300, [&](const test::Moment& m) {
      path.push_back(of_camera ? m.input.goal_from_camera->translation : m.pose.translation);
    });
    return bow(path);
  };
  EXPECT_LT(bow_of(Law::PbvsCt, true), 1e-3);
  EXPECT_GT(bow_of(Law::PbvsCo, true), 1e-2);
  EXPECT_LT(bow_of(Law::PbvsCo, false), 1e-3);
  EXPECT_GT(bow_of(Law::PbvsCt, false), 1e-2);
}

// exp((1 - dt) xi) is where exp(xi) gets to: the twist shrinks and never turns.
TEST(PoseLaws, ScrewKeepsItsAxis) {
  const Vector6d first = test::twist_at(test::kS0, Law::Screw);
  double share = 1;
  test::fly(test::kS0, test::unit_options(Law::Screw), 300, 1.0 / 30, [&](const test::Moment& m) {
    EXPECT_LT((m.answer.twist->vector() - share * first).norm(), 1e-12);
    share *= 1 - 1.0 / 30;
  });
}

// The reference point's image goes straight home, and its depth ratio with it.
TEST(PoseLaws, HybridConvergesFromHalfATurn) {
  for (const TargetPose& start : {test::turned_about_axis(180), test::turned_about_axis(179),
                                  test::kS0, test::kS5, test::kS8}) {
    const TargetPose end = test::fly(start, test::unit_options(Law::TwoAndHalfD), 600, 1.0 / 30);
    EXPECT_LT(test::error_at(end), 1e-6);
  }
  const double retreat =
      test::retreat_on_flight(test::turned_about_axis(180), Law::TwoAndHalfD, 300, 1.0 / 30);
  EXPECT_LT(retreat, 1e-9);
}

TEST(PoseLaws, AnswerNearTheGoalIsTheDisplacement) {
  test::Random random("near the goal");
  for (const Law law : kPoseLaws) {
    const Vector6d xi = 1e-5 * (Vector6d() << random.vector3(1), random.vector3(1)).finished();
    const Displacement d = exponential(xi, 1);
    const Vector6d v = test::twist_at(test::seen_from(d), law);
    EXPECT_LT((v + xi).norm(), 1e-9) << name(law);  // second order
    EXPECT_LT(test::twist_at(test::kBenchGoal, law).norm(), 1e-15) << name(law);
  }
}

TEST(PoseLaws, TakeTheGoalFromTheTargetsPosesWhenItIsNotGiven) {
  for (const Law law : kPoseLaws) {
    LawInput input = test::input_at(test::kS0);
    input.goal_from_camera.reset();
    const LawAnswer answer = control_law(input, test::unit_options(law));
    ASSERT_TRUE(answer.twist);
    EXPECT_LT((answer.twist->vector() - test::twist_at(test::kS0, law)).norm(), 1e-14);
  }
}

// The part of the twist that the vehicle can make: what is left over is square to all it can do.
TEST(PoseLaws, InABasisTheNearestTwist) {
  for (const Law law : kPoseLaws) {
    LawInput input = test::input_at(test::kS0);
    input.basis =
        test::oracle_basis(test::forward_mount({.3, 0, .1}), Freedom::Four).cast<double>();
    const LawAnswer answer = control_law(input, test::unit_options(law));
    ASSERT_TRUE(answer.twist);
    const Vector6d left = test::twist_at(test::kS0, law) - answer.twist->vector();
    EXPECT_LT((input.basis.transpose() * left).norm(), 1e-13) << name(law);
    const Eigen::MatrixXd both =
        (Eigen::MatrixXd(6, 5) << input.basis, answer.twist->vector()).finished();
    EXPECT_LT(test::singular_values(both)[4], 1e-13) << name(law);
  }
}

LawRefusal refusal(const LawInput& input, Law law) {
  const LawAnswer answer = control_law(input, test::unit_options(law));
  EXPECT_EQ(bool(answer.twist), answer.refusal == LawRefusal::None);
  return answer.refusal;
}

TEST(PoseLaws, RefuseWhatIsNoPose) {
  for (const Law law : kPoseLaws) {
    LawInput input = test::input_at(test::kS0);
    input.goal_from_camera->rotation *= 1.01;
    EXPECT_EQ(refusal(input, law), LawRefusal::Pose) << name(law);
    input.goal_from_camera->rotation = -test::kS0.rotation;
    EXPECT_EQ(refusal(input, law), LawRefusal::Pose) << name(law);
    input.goal_from_camera.reset();
    input.goal_from_target.reset();
    EXPECT_EQ(refusal(input, law), LawRefusal::Pose) << name(law);
    input = test::input_at(test::kS0);
    input.goal_from_camera->translation.x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refusal(input, law), LawRefusal::NotFinite) << name(law);
  }
}

TEST(PoseLaws, RefuseWhenTheTargetsPoseIsMissingOrBehind) {
  LawInput input = test::input_at(test::kS0);
  input.camera_from_target.reset();
  EXPECT_EQ(refusal(input, Law::PbvsCt), LawRefusal::None);
  EXPECT_EQ(refusal(input, Law::Screw), LawRefusal::None);
  EXPECT_EQ(refusal(input, Law::PbvsCo), LawRefusal::Pose);
  EXPECT_EQ(refusal(input, Law::TwoAndHalfD), LawRefusal::Pose);
  input = test::input_at(test::kS0);
  input.camera_from_target->translation.z() = -1;
  EXPECT_EQ(refusal(input, Law::TwoAndHalfD), LawRefusal::Depth);
  input.camera_from_target->translation.z() = 0;
  EXPECT_EQ(refusal(input, Law::TwoAndHalfD), LawRefusal::Depth);
}

}  // namespace
}  // namespace kestrel

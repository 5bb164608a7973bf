// polar, partition, homog and decoupled: the laws that look at the image in their own way.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "servo/law_rates.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

LawRefusal refusal(const LawInput& input, Law law) {
  const LawAnswer answer = control_law(input, test::unit_options(law));
  EXPECT_EQ(bool(answer.twist), answer.refusal == LawRefusal::None);
  return answer.refusal;
}

double nearest_to_axis(const TargetPose& pose) {
  double least = 1;
  for (const Feature& f : features(pose, test::kBenchSquare)) {
    least = std::min(least, std::hypot(f.at.x, f.at.y));
  }
  return least;
}

TEST(PolarLaw, IsThePseudoInverseOfItsRates) {
  test::Random random("polar");
  for (int i = 0; i < 30; ++i) {
    TargetPose pose = test::any_view(random, 1.2, 0.3);
    while (nearest_to_axis(pose) < 0.03) pose = test::any_view(random, 1.2, 0.3);
    const LawAnswer answer = control_law(test::input_at(pose), test::unit_options(Law::Polar));
    ASSERT_TRUE(answer.twist);
    const Eigen::MatrixXd L = test::error_rate(pose, Law::Polar);
    const double size = L.norm();  // up to 1 / 0.03
    // Least squares: what is left over is square to the columns.
    const Eigen::VectorXd left = L * answer.twist->vector() + answer.error;
    EXPECT_LT((L.transpose() * left).norm(), 1e-7 * size * size);
    EXPECT_LT((test::singular_values(L) - answer.singular_values).norm(), 1e-7 * size);
  }
}

// A turn about the axis is a turn of every theta: nothing else moves.
TEST(PolarLaw, TurnsWithoutRetreat) {
  for (const double deg : {45.0, 90.0, 135.0, 160.0, 179.0, -120.0}) {
    const Vector6d v = test::twist_at(test::turned_about_axis(deg), Law::Polar);
    EXPECT_LT((v - (Vector6d() << 0, 0, 0, 0, 0, -deg * M_PI / 180).finished()).norm(), 1e-12);
    EXPECT_LT(test::retreat_on_flight(test::turned_about_axis(deg), Law::Polar, 60, 1.0 / 30),
              1e-12);
  }
}

TEST(PolarLaw, HasNoAngleOnTheAxis) {
  for (const double at : {0.0, 1e-10}) {
    LawInput input = test::input_at(test::kS0);
    input.measured[2].at = {at, 0};
    EXPECT_EQ(refusal(input, Law::Polar), LawRefusal::Singular);
    input = test::input_at(test::kS0);
    input.desired[1].at = {0, -at};
    EXPECT_EQ(refusal(input, Law::Polar), LawRefusal::Singular);
  }
  LawInput beside = test::input_at(test::kS0);
  beside.measured[2].at = {1e-6, 0};
  EXPECT_EQ(refusal(beside, Law::Polar), LawRefusal::None);
}

double shoelace(const std::vector<Feature>& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const std::size_t j = (i + 1) % p.size();
    twice += p[i].at.x * p[j].at.y - p[j].at.x * p[i].at.y;
  }
  return twice / 2;
}

/// z-velocities as the paper has them, and the rest square to what is left over: L_xy^T (e + L v).
void expect_partition(const LawInput& input, const Vector6d& v, const std::vector<int>& rest) {
  const auto angle = [](const std::vector<Feature>& p) {
    return std::atan2(p[1].at.y - p[0].at.y, p[1].at.x - p[0].at.x);
  };
  const double areas = shoelace(input.desired) / shoelace(input.measured);
  EXPECT_NEAR(v[2], 0.75 * std::log(std::sqrt(areas)), 1e-13);
  EXPECT_NEAR(v[5], wrap_angle(angle(input.measured) - angle(input.desired)), 1e-13);
  const Eigen::MatrixXd L = test::oracle_interaction(input.measured).cast<double>();
  const Eigen::VectorXd left = test::stacked(input.measured) - test::stacked(input.desired) + L * v;
  for (const int k : rest) EXPECT_LT(std::abs(L.col(k).dot(left)), 1e-12) << k;
}

TEST(PartitionLaw, IsSizeAndDirectionFirstAndThenTheRest) {
  test::Random random("partition");
  for (int i = 0; i < 50; ++i) {
    const LawInput input = test::input_at(test::any_view(random, 3, 0.5));
    const LawAnswer answer = control_law(input, test::unit_options(Law::Partition));
    ASSERT_TRUE(answer.twist);
    expect_partition(input, answer.twist->vector(), {0, 1, 3, 4});
    EXPECT_EQ(answer.rank, 4);
  }
}

// A camera that looks down on a vehicle that keeps level: the axis is the vehicle's, vx and vy are
// left for the rest. One that looks forward cannot roll: vz is along, three are left.
TEST(PartitionLaw, InABasisTheRestIsWhatTheAxisLeaves) {
  test::Random random("partition in a basis");
  LawInput input = test::input_at(test::any_view(random, 1, 0.3));
  input.basis = test::oracle_basis(test::down_mount({0, 0, 0}), Freedom::Four).cast<double>();
  const LawAnswer down = control_law(input, test::unit_options(Law::Partition));
  ASSERT_TRUE(down.twist);
  expect_partition(input, down.twist->vector(), {0, 1});
  EXPECT_EQ(down.rank, 2);
  input.basis = test::oracle_basis(test::forward_mount({0, 0, 0}), Freedom::Four).cast<double>();
  const LawAnswer forward = control_law(input, test::unit_options(Law::Partition));
  ASSERT_TRUE(forward.twist);
  EXPECT_EQ(forward.rank, 3);
  EXPECT_NEAR(forward.twist->linear.z(),
              test::twist_at(*input.camera_from_target, Law::Partition)[2], 1e-13);
  EXPECT_LT(std::abs(forward.twist->angular.x()) + std::abs(forward.twist->angular.z()), 1e-13);
  input.basis = Vector6d::Unit(2);
  EXPECT_EQ(refusal(input, Law::Partition), LawRefusal::Unreachable);
}

TEST(PartitionLaw, TurnsWithoutRetreat) {
  for (const double deg : {45.0, 90.0, 160.0, 179.0}) {
    const TargetPose start = test::turned_about_axis(deg);
    EXPECT_LT(test::retreat_on_flight(start, Law::Partition, 300, 1.0 / 30), 1e-3);
    EXPECT_NEAR(test::twist_at(start, Law::Partition)[5], -deg * M_PI / 180, 1e-13);
  }
}

// Benhimane & Malis: locally stable, with the modes 1, 1 and twice each 1 +- 1/sqrt(2).
TEST(HomographyLaw, ModesAtTheGoal) {
  Matrix6d rate;
  const double h = 1e-6;
  for (int k = 0; k < 6; ++k) {
    const auto at = [&](double x) {
      return test::twist_at(test::after(test::kBenchGoal, x * Vector6d::Unit(k), 1), Law::Homog);
    };
    rate.col(k) = (at(h) - at(-h)) / (2 * h);
  }
  const double r = std::sqrt(0.5);
  const Vector6d expected = (Vector6d() << -1 - r, -1 - r, -1, -1, -1 + r, -1 + r).finished();
  EXPECT_LT((test::modes(rate) - expected).norm(), 1e-8);
}

TEST(HomographyLaw, IsTheDisplacementWhenThereIsNoTurn) {
  const Vector6d v = test::twist_at(test::kS8, Law::Homog);
  // e_v is t / d, and half of e_w is (n x t) / 2d.
  EXPECT_LT((v.head<3>() - Eigen::Vector3d(-.5, .3, .75)).norm(), 1e-13);
  EXPECT_LT((v.tail<3>() - Eigen::Vector3d(-.3, -.5, 0) / 1.5).norm(), 1e-13);
}

TEST(HomographyLaw, TakesAnyScaleAndRefusesWhatIsNone) {
  const Vector6d expected = test::twist_at(test::kS0, Law::Homog);
  for (const double scale : {-1.0, 17.0, -1e-4}) {
    LawInput input = test::input_at(test::kS0);
    *input.camera_from_goal_homography *= scale;
    const LawAnswer answer = control_law(input, test::unit_options(Law::Homog));
    ASSERT_TRUE(answer.twist);
    EXPECT_LT((answer.twist->vector() - expected).norm(), 1e-13);
  }
  LawInput input = test::input_at(test::kS0);
  input.camera_from_goal_homography->setZero();
  EXPECT_EQ(refusal(input, Law::Homog), LawRefusal::Homography);
  input.camera_from_goal_homography.reset();
  EXPECT_EQ(refusal(input, Law::Homog), LawRefusal::Homography);
}

// Exact for a target that faces the camera, at any distance; no rates, whatever the turn.
TEST(DecoupledLaw, IsTheDisplacementOfAFacingTarget) {
  const Vector6d v = test::twist_at(test::kS8, Law::Decoupled);
  EXPECT_LT((v - (Vector6d() << -.5, .3, .75, 0, 0, 0).finished()).norm(), 1e-13);
  EXPECT_EQ(test::twist_at(test::kS0, Law::Decoupled).tail<3>().norm(), 0);
}

TEST(DecoupledLaw, DoesNotMindTheOrderOfThePoints) {
  LawInput input = test::input_at(test::kS0);
  std::swap(input.measured[0], input.measured[1]);
  std::swap(input.desired[0], input.desired[1]);
  const LawAnswer answer = control_law(input, test::unit_options(Law::Decoupled));
  ASSERT_TRUE(answer.twist);
  EXPECT_LT((answer.twist->vector() - test::twist_at(test::kS0, Law::Decoupled)).norm(), 1e-14);
  EXPECT_EQ(answer.rank, 3);
}

TEST(ImageLaws, ConvergeFromTheTutorialsStart) {
  for (const Law law : {Law::Polar, Law::Partition, Law::Homog, Law::Moments}) {
    const TargetPose end = test::fly(test::kS0, test::unit_options(law), 1200, 1.0 / 30);
    EXPECT_LT(test::error_at(end), 1e-3) << name(law);
  }
}

TEST(ImageLaws, NameWhatIsWrong) {
  for (const Law law : {Law::Partition, Law::Decoupled, Law::Moments}) {
    LawInput input = test::input_at(test::kS0);
    input.measured.pop_back();
    input.desired.pop_back();
    EXPECT_EQ(refusal(input, law), LawRefusal::FewPoints) << name(law);
    input = test::input_at(test::kS0);
    for (std::size_t i = 0; i < 4; ++i) input.measured[i].at = {.1 * double(i), .05 * double(i)};
    EXPECT_EQ(refusal(input, law), LawRefusal::Collinear) << name(law);
    input = test::input_at(test::kS0);
    input.measured[1].at.y = kNan;
    EXPECT_EQ(refusal(input, law), LawRefusal::NotFinite) << name(law);
  }
}

}  // namespace
}  // namespace kestrel

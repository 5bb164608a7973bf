#include <complex>

#include <gtest/gtest.h>
#include <visp3/core/vpMomentCommon.h>
#include <visp3/core/vpMomentObject.h>
#include <visp3/core/vpPoint.h>
#include <visp3/visual_features/vpFeatureMomentCommon.h>

#include "servo/law_rates.hpp"
#include "support/random.hpp"

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;  // NOLINT(google-build-using-namespace): ViSP after 3.6
#endif

namespace kestrel {
namespace {

/// A quadrangle without any symmetry: all its moments are its own.
const std::array<Eigen::Vector3d, 4> kKite{
    {{-.12, -.08, 0}, {.1, -.1, 0}, {.14, .07, 0}, {-.05, .12, 0}}};

LawInput kite_at(const TargetPose& pose, const TargetPose& goal) {
  LawInput input;
  input.measured = features(pose, kKite);
  input.desired = features(goal, kKite);
  return input;
}

LawAnswer answer_to(const LawInput& input) {
  return control_law(input, test::unit_options(Law::Moments));
}

/// Any view square on: the case the law is exact for.
TargetPose facing_view(test::Random& random) {
  return {rotation_from_vector({0, 0, random.uniform(-2.5, 2.5)}),
          {random.uniform(-.2, .2), random.uniform(-.2, .2), random.uniform(.5, 1.5)}};
}

const TargetPose kGoal{rotation_from_vector({0, 0, 0.3}), {.02, -.03, .75}};

vpMomentObject area_of(const std::vector<Feature>& points) {
  std::vector<vpPoint> corners;
  for (std::size_t i = 0; i <= points.size(); ++i) {  // ViSP wants the polygon closed
    vpPoint corner;
    corner.set_x(points[i % points.size()].at.x);
    corner.set_y(points[i % points.size()].at.y);
    corners.push_back(corner);
  }
  vpMomentObject object(6);
  object.setType(vpMomentObject::DENSE_POLYGON);
  object.fromVector(corners);
  return object;
}

/// (xn, yn, an, alpha) and the rows of the first three, by ViSP.
struct VispMoments {
  Eigen::Vector4d s;
  Eigen::Matrix<double, 3, 6> L;
};

VispMoments visp_moments(const std::vector<Feature>& points, const LawInput& input,
                         double depth_m) {
  vpMomentObject object = area_of(points);
  vpMomentObject goal = area_of(input.desired);
  vpMomentCommon moments(vpMomentCommon::getSurface(goal), vpMomentCommon::getMu3(goal),
                         vpMomentCommon::getAlpha(goal), 0.75);
  moments.updateAll(object);
  vpFeatureMomentCommon rates(moments);
  rates.updateAll(0, 0, 1 / depth_m);
  VispMoments all;
  bool found = false;
  const auto values = [&](const char* moment) { return moments.get(moment, found).get(); };
  const auto centre = values("vpMomentGravityCenterNormalized");
  all.s << centre[0], centre[1], values("vpMomentAreaNormalized")[0], values("vpMomentAlpha")[0];
  const vpMatrix xy = rates.getFeatureGravityNormalized().interaction(vpBasicFeature::FEATURE_ALL);
  const vpMatrix a = rates.getFeatureAn().interaction(vpBasicFeature::FEATURE_ALL);
  for (unsigned k = 0; k < 6; ++k) all.L.col(k) << xy[0][k], xy[1][k], a[0][k];
  return all;
}

TEST(MomentsLaw, CentreAndSizeAreThoseOfVisp) {
  test::Random random("moments of ViSP");
  for (int i = 0; i < 20; ++i) {
    const LawInput input = kite_at(facing_view(random), kGoal);
    const LawAnswer answer = answer_to(input);
    ASSERT_TRUE(answer.twist);
    const double depth_m = input.measured[0].depth_m;
    const VispMoments now = visp_moments(input.measured, input, depth_m);
    const VispMoments goal = visp_moments(input.desired, input, 0.75);
    EXPECT_LT((answer.error.head<3>() - (now.s - goal.s).head<3>()).norm(), 1e-10);
    // ViSP's rows make the first three errors decay under this law's twist.
    EXPECT_LT((now.L * answer.twist->vector() + answer.error.head<3>()).norm(), 1e-10);
    EXPECT_LT(std::abs(std::sin(answer.error[5] - (now.s[3] - goal.s[3]))), 1e-9);
  }
}

// The rows as the literature has them for a target parallel to the image (Tahri & Chaumette 2005).
TEST(MomentsLaw, RowsOfCentreAndSize) {
  test::Random random("rows");
  const auto at = [](const TargetPose& pose) { return kite_at(pose, kGoal); };
  for (int i = 0; i < 10; ++i) {
    const TargetPose pose = facing_view(random);
    const VispMoments by_visp =
        visp_moments(at(pose).measured, at(pose), at(pose).measured[0].depth_m);
    const Eigen::MatrixXd L = test::error_rate(pose, Law::Moments, at);
    EXPECT_LT((L.topRows<3>() - by_visp.L).norm(), 1e-8);
  }
}

// All six features decay while target and goal face the camera; the matrix is then the true one.
TEST(MomentsLaw, MakesItsErrorDecayAtTheGain) {
  test::Random random("moments decay");
  const auto at = [](const TargetPose& pose) { return kite_at(pose, kGoal); };
  for (int i = 0; i < 20; ++i) {
    const TargetPose pose = facing_view(random);
    const LawAnswer answer = answer_to(at(pose));
    ASSERT_TRUE(answer.twist);
    const Eigen::MatrixXd L = test::error_rate(pose, Law::Moments, at);
    EXPECT_LT((L * answer.twist->vector() + answer.error).norm(), 1e-7);
    EXPECT_LT((test::singular_values(L) - answer.singular_values).norm(), 1e-6);
    EXPECT_LT(answer.error.segment<2>(3).norm(), 1e-12);  // no tilt in sight
  }
}

// Also where the goal is oblique: the law believes the goal's plane, right at the goal.
TEST(MomentsLaw, AnswerNearTheGoalIsTheDisplacement) {
  test::Random random("moments near the goal");
  for (const double tilt : {0.0, 0.3, -0.7}) {
    const TargetPose goal{rotation_from_vector({tilt, 0.1 * tilt, 0.2}), {.02, -.03, .75}};
    const Vector6d xi = 1e-5 * (Vector6d() << random.vector3(1), random.vector3(1)).finished();
    const LawAnswer answer = answer_to(kite_at(test::after(goal, xi, 1), goal));
    ASSERT_TRUE(answer.twist);
    // Second order, times how little the tilt shows.
    EXPECT_LT((answer.twist->vector() + xi).norm(), 1e-3 * xi.norm()) << tilt;
  }
}

TEST(MomentsLaw, ASquareAnswersATiltByOne) {
  const Eigen::MatrixXd L = test::error_rate(test::kBenchGoal, Law::Moments);
  EXPECT_NEAR(L(3, 4), -1, 1e-6);
  EXPECT_NEAR(L(4, 3), 1, 1e-6);
  EXPECT_NEAR(L(5, 5), -1, 1e-9);
  EXPECT_LT((L.topLeftCorner<3, 3>() + Eigen::Matrix3d::Identity()).norm(), 1e-8);
}

// Translations of a target that faces the camera: the twist is the displacement, however far.
TEST(MomentsLaw, IsTheDisplacementOfAFacingTarget) {
  const Vector6d v = test::twist_at(test::kS8, Law::Moments);
  EXPECT_LT((v - (Vector6d() << -.5, .3, .75, 0, 0, 0).finished()).norm(), 1e-10);
  const Vector6d turn = test::twist_at(test::turned_about_axis(160), Law::Moments);
  EXPECT_LT((turn + Vector6d::Unit(5) * 160 * M_PI / 180).norm(), 1e-10);
}

TEST(MomentsLaw, DoesNotMindTheOrderOfThePointsOrOnesInside) {
  LawInput input = test::input_at(test::kS0);
  const LawAnswer expected = answer_to(input);
  std::swap(input.measured[0], input.measured[1]);
  std::swap(input.desired[0], input.desired[1]);
  const LawAnswer swapped = answer_to(input);
  ASSERT_TRUE(expected.twist && swapped.twist);
  EXPECT_LT((expected.twist->vector() - swapped.twist->vector()).norm(), 1e-11);
  const auto add_centre = [](std::vector<Feature>& points, const TargetPose& pose) {
    const Eigen::Vector3d p = pose.translation;
    points.push_back({{p.x() / p.z(), p.y() / p.z()}, p.z()});
  };
  add_centre(input.measured, test::kS0);
  add_centre(input.desired, test::kBenchGoal);
  const LawAnswer with_centre = answer_to(input);
  ASSERT_TRUE(with_centre.twist);
  EXPECT_LT((expected.error - with_centre.error).head<3>().norm(), 1e-13);
}

// It never looks at the measured depths.
TEST(MomentsLaw, NeedsNoDepthOfTheView) {
  LawInput input = test::input_at(test::kS0);
  const LawAnswer expected = answer_to(input);
  for (Feature& f : input.measured) f.depth_m = std::numeric_limits<double>::quiet_NaN();
  const LawAnswer answer = answer_to(input);
  ASSERT_TRUE(answer.twist);
  EXPECT_EQ(answer.twist->vector(), expected.twist->vector());
}

}  // namespace
}  // namespace kestrel

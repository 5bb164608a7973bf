// ViSP computes the laws that it has: the same twists to rounding, at any view.
#include <gtest/gtest.h>
#include <visp3/visual_features/vpFeatureBuilder.h>
#include <visp3/visual_features/vpFeatureDepth.h>
#include <visp3/visual_features/vpFeaturePoint.h>
#include <visp3/visual_features/vpFeaturePointPolar.h>
#include <visp3/visual_features/vpFeatureThetaU.h>
#include <visp3/visual_features/vpFeatureTranslation.h>
#include <visp3/vs/vpServo.h>

#include "servo/law_rates.hpp"
#include "support/random.hpp"

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;  // NOLINT(google-build-using-namespace): ViSP after 3.6
#endif

namespace kestrel {
namespace {

vpHomogeneousMatrix to_visp(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
  vpHomogeneousMatrix M;
  for (unsigned i = 0; i < 3; ++i) {
    for (unsigned j = 0; j < 3; ++j) M[i][j] = R(i, j);
    M[i][3] = t[i];
  }
  return M;
}

/// vpServo with its features for as long as it needs them.
class VispLaw {
 public:
  VispLaw() {
    task_.setServo(vpServo::EYEINHAND_CAMERA);
    task_.setInteractionMatrixType(vpServo::CURRENT, vpServo::PSEUDO_INVERSE);
    task_.setLambda(1.0);
  }
  ~VispLaw() { task_.kill(); }
  VispLaw(const VispLaw&) = delete;
  VispLaw& operator=(const VispLaw&) = delete;

  void add(vpBasicFeature& s, vpBasicFeature& s_star) { task_.addFeature(s, s_star); }
  void add(vpBasicFeature& s) { task_.addFeature(s); }
  Vector6d twist() {
    const vpColVector v = task_.computeControlLaw();
    return Eigen::Map<const Vector6d>(v.data);
  }

 private:
  vpServo task_;
};

// Conditions up to 300 and ViSP's own SVD: 1e-13 times that.
constexpr double kAgreement = 1e-10;

template <class VispTwist>
void expect_agreement(Law law, double max_turn_rad, const VispTwist& visp_twist) {
  test::Random random(name(law));
  for (int i = 0; i < 30; ++i) {
    const TargetPose pose = test::any_view(random, max_turn_rad, 0.4);
    const LawInput input = test::input_at(pose);
    EXPECT_LT((test::twist_at(pose, law) - visp_twist(input)).norm(), kAgreement) << name(law);
  }
}

vpHomogeneousMatrix goal_from_camera(const LawInput& input) {
  return to_visp(input.goal_from_camera->rotation, input.goal_from_camera->translation);
}

TEST(LawsAndVisp, CameraOnAStraightLine) {
  expect_agreement(Law::PbvsCt, 2.5, [](const LawInput& input) {
    vpFeatureTranslation t(vpFeatureTranslation::cdMc);
    t.buildFrom(goal_from_camera(input));
    vpFeatureThetaU tu(vpFeatureThetaU::cdRc);
    tu.buildFrom(goal_from_camera(input));
    VispLaw law;
    law.add(t);
    law.add(tu);
    return law.twist();
  });
}

TEST(LawsAndVisp, TargetOnAStraightLine) {
  expect_agreement(Law::PbvsCo, 2.5, [](const LawInput& input) {
    const auto pose = [](const TargetPose& p) { return to_visp(p.rotation, p.translation); };
    vpFeatureTranslation t(vpFeatureTranslation::cMo);
    t.buildFrom(pose(*input.camera_from_target));
    vpFeatureTranslation t_star(vpFeatureTranslation::cMo);
    t_star.buildFrom(pose(*input.goal_from_target));
    vpFeatureThetaU tu(vpFeatureThetaU::cdRc);
    tu.buildFrom(goal_from_camera(input));
    VispLaw law;
    law.add(t, t_star);
    law.add(tu);
    return law.twist();
  });
}

TEST(LawsAndVisp, TwoAndAHalfD) {
  expect_agreement(Law::TwoAndHalfD, 2.5, [](const LawInput& input) {
    const Eigen::Vector3d now = input.camera_from_target->translation;
    const Eigen::Vector3d goal = input.goal_from_target->translation;
    vpFeaturePoint p;
    p.buildFrom(now.x() / now.z(), now.y() / now.z(), now.z());
    vpFeaturePoint p_star;
    p_star.buildFrom(goal.x() / goal.z(), goal.y() / goal.z(), goal.z());
    vpFeatureDepth depth;
    depth.buildFrom(now.x() / now.z(), now.y() / now.z(), now.z(), std::log(now.z() / goal.z()));
    vpFeatureThetaU tu(vpFeatureThetaU::cdRc);
    tu.buildFrom(goal_from_camera(input));
    VispLaw law;
    law.add(p, p_star);
    law.add(depth);
    law.add(tu);
    return law.twist();
  });
}

TEST(LawsAndVisp, Polar) {
  expect_agreement(Law::Polar, 1.2, [](const LawInput& input) {
    std::vector<vpFeaturePointPolar> s(4);
    std::vector<vpFeaturePointPolar> s_star(4);
    VispLaw law;
    const auto polar = [](const Feature& f) {
      vpFeaturePointPolar p;
      p.buildFrom(std::hypot(f.at.x, f.at.y), std::atan2(f.at.y, f.at.x), f.depth_m);
      return p;
    };
    for (std::size_t i = 0; i < 4; ++i) {
      s[i] = polar(input.measured[i]);
      s_star[i] = polar(input.desired[i]);
      law.add(s[i], s_star[i]);
    }
    return law.twist();
  });
}

}  // namespace
}  // namespace kestrel

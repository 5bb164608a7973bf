#include "kestrel/servo/helicopter_law.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include "kestrel/geometry/rotation.hpp"

#include "servo/law_bench.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

using Variant = HelicopterVariant;

constexpr double kGain = 0.7;

Mount forward(const Eigen::Vector3d& place_m) {
  Eigen::Matrix3d R;
  R << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return {R, place_m};
}

/// The benchmark's: 1 m square, 5 m ahead.
std::array<Eigen::Vector3d, 4> square() {
  using Eigen::Vector3d;
  return {Vector3d(-0.5, -0.5, 0), Vector3d(0.5, -0.5, 0), Vector3d(0.5, 0.5, 0),
          Vector3d(-0.5, 0.5, 0)};
}

TargetPose at_goal() { return {Eigen::Matrix3d::Identity(), {0, 0, 5}}; }

TargetPose random_view(test::Random& random) {
  return {rotation_from_vector(random.rotation_vector(0.3)),
          Eigen::Vector3d(0, 0, 6) + random.vector3(1)};
}

/// The target seen by the camera on the tilted helicopter that would see it like this when level.
HelicopterLawInput tilted(const TargetPose& level_camera_from_target, const Attitude& attitude,
                          const Mount& mount) {
  HelicopterLawInput input;
  const Eigen::Matrix3d R = level_camera_from_camera(mount.rotation, attitude);
  const TargetPose camera_from_target =
      TargetPose{R.transpose() * level_camera_from_target.rotation,
                 R.transpose() * level_camera_from_target.translation};
  input.camera.measured = features(camera_from_target, square());
  input.camera.desired = features(at_goal(), square());
  input.body_from_camera = mount;
  input.attitude = attitude;
  return input;
}

HelicopterLawOptions with(Variant variant, Law law) {
  HelicopterLawOptions options;
  options.variant = variant;
  options.law.law = law;
  options.law.gain = LawGain::constant(kGain);
  options.heading_gain_per_s = kGain;
  return options;
}

Vector6d velocities(const HelicopterLawInput& input, const HelicopterLawOptions& options) {
  const HelicopterLawAnswer answer = helicopter_law(input, options);
  EXPECT_TRUE(answer.twist) << name(answer.refusal);
  return answer.twist ? answer.twist->vector() : Vector6d::Constant(NAN);
}

// The formulas of the header once more, by Eigen alone.
using Matrix = Eigen::MatrixXd;

Matrix interaction(const std::vector<Feature>& points) {
  Matrix L(2 * points.size(), 6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i].at.x;
    const double y = points[i].at.y;
    const double Z = points[i].depth_m;
    L.row(Eigen::Index(2 * i)) << -1 / Z, 0, x / Z, x * y, -(1 + x * x), y;
    L.row(Eigen::Index(2 * i + 1)) << 0, -1 / Z, y / Z, 1 + y * y, -x * y, -x;
  }
  return L;
}

Matrix interaction(Law law, const HelicopterLawInput& input) {
  const Matrix now = interaction(input.camera.measured);
  const Matrix goal = interaction(input.camera.desired);
  return law == Law::Cur ? now : law == Law::Des ? goal : Matrix((now + goal) / 2);
}

Eigen::VectorXd error(const HelicopterLawInput& input) {
  Eigen::VectorXd e(8);
  for (Eigen::Index i = 0; i < 4; ++i) {
    const ImagePoint& s = input.camera.measured[std::size_t(i)].at;
    const ImagePoint& goal = input.camera.desired[std::size_t(i)].at;
    e.segment<2>(2 * i) << s.x - goal.x, s.y - goal.y;
  }
  return e;
}

/// L cVb S4.
Matrix task(const Matrix& L, const Mount& mount) {
  const Eigen::Matrix3d cRb = mount.rotation.transpose();
  Matrix cVb = Matrix::Zero(6, 6);
  cVb.topLeftCorner<3, 3>() = cRb;
  cVb.bottomRightCorner<3, 3>() = cRb;
  cVb.topRightCorner<3, 3>() = skew(-cRb * mount.translation) * cRb;
  const Matrix all = L * cVb;
  Matrix A(L.rows(), 4);
  A << all.leftCols(3), all.col(5);
  return A;
}

TEST(HelicopterLaw, LevelVariantsAreTheirFormulas) {
  test::Random random("formulas");
  const Mount mount = forward({0.3, -0.05, 0.1});
  for (const Law law : {Law::Cur, Law::Des, Law::Mean}) {
    for (int i = 0; i < 10; ++i) {
      HelicopterLawInput input = tilted(random_view(random), {}, mount);
      input.heading_rad = random.uniform(-3, 3);
      input.goal_heading_rad = random.uniform(-3, 3);
      const Matrix A = task(interaction(law, input), mount);
      const Eigen::VectorXd e = error(input);
      const Eigen::Vector4d u4 = -kGain * test::solved(A, e);
      const Eigen::Vector3d u3 = -kGain * test::solved(Matrix(A.leftCols(3)), e);
      const double r = -kGain * wrap_angle(input.heading_rad - input.goal_heading_rad);
      const Eigen::Vector3d held = -test::solved(Matrix(A.leftCols(3)), kGain * e + A.col(3) * r);
      Vector6d expected = Vector6d::Zero();
      expected.head<3>() = u4.head<3>();
      expected[5] = u4[3];
      // Condition 600 leaves 13 digits of velocities of some m/s.
      EXPECT_LT((velocities(input, with(Variant::Vp4, law)) - expected).norm(), 1e-11);
      EXPECT_LT((velocities(input, with(Variant::Raw4, law)) - expected).norm(), 1e-11);
      expected << u3, 0, 0, 0;
      EXPECT_LT((velocities(input, with(Variant::Vp3, law)) - expected).norm(), 1e-12);
      expected << held, 0, 0, r;
      EXPECT_LT((velocities(input, with(Variant::Vp3Hh, law)) - expected).norm(), 1e-12);
    }
  }
}

TEST(HelicopterLaw, Drop6ThrowsRollAndPitchRatesAwayOnly) {
  test::Random random("drop6");
  const Mount mount = forward({0.3, 0, 0.1});
  const HelicopterLawInput input = tilted(random_view(random), {0.05, -0.1, 0}, mount);
  const Vector6d v = -kGain * test::solved(interaction(input.camera.measured), error(input));
  Vector6d body = (mount * CameraTwist::from_vector(v)).vector();
  EXPECT_GT(body.segment<2>(3).norm(), 1e-3);
  body.segment<2>(3).setZero();
  EXPECT_LT((velocities(input, with(Variant::Drop6, Law::Cur)) - body).norm(), 1e-11);
}

TEST(HelicopterLaw, LevelVariantsDoNotSeeTheTilt) {
  test::Random random("tilt");
  const Attitude attitude{0.2, -0.15, 1};
  const Mount mount = forward({0.3, -0.05, 0.1});
  // The lever arm turns with the helicopter, the axes of the level camera do not.
  const Mount level{mount.rotation, level_from_body(attitude) * mount.translation};
  for (const Variant variant : {Variant::Vp4, Variant::Vp3Hh, Variant::Vp3}) {
    const TargetPose view = random_view(random);
    HelicopterLawInput flat = tilted(view, {}, level);
    HelicopterLawInput input = tilted(view, attitude, mount);
    input.heading_rad = flat.heading_rad = 0.1;
    const HelicopterLawOptions options = with(variant, Law::Mean);
    EXPECT_LT((velocities(input, options) - velocities(flat, options)).norm(), 1e-11);
  }
}

TEST(HelicopterLaw, PosesAreLevelledLikePoints) {
  test::Random random("poses");
  const Attitude attitude{0.2, -0.15, 1};
  const Mount mount = forward({0, 0, 0});
  const TargetPose view = random_view(random);
  const HelicopterLawInput flat = tilted(view, {}, mount);
  HelicopterLawInput input = tilted(view, attitude, mount);
  const auto add_poses = [](HelicopterLawInput& told, const TargetPose& camera_from_target) {
    const CameraMotion motion = at_goal() * camera_from_target.inverse();
    told.camera.goal_from_camera = Displacement{motion.rotation, motion.translation};
    told.camera.camera_from_target = camera_from_target;
    told.camera.goal_from_target = at_goal();
  };
  HelicopterLawInput level = flat;
  add_poses(level, view);
  const Eigen::Matrix3d R = level_camera_from_camera(mount.rotation, attitude);
  add_poses(input, TargetPose{R.transpose() * view.rotation, R.transpose() * view.translation});
  const HelicopterLawOptions options = with(Variant::Vp4, Law::PmjT);
  EXPECT_LT((velocities(input, options) - velocities(level, options)).norm(), 1e-11);
}

TEST(HelicopterLaw, TheUnlevelledDoNotLookAtTheAttitude) {
  test::Random random("imu");
  HelicopterLawInput input = tilted(random_view(random), {0.1, 0.1, 0}, forward({0.3, 0, 0.1}));
  HelicopterLawInput other = input;
  other.attitude = {-0.3, 0.2, 0.5};
  for (const Variant variant : {Variant::Raw4, Variant::Drop6}) {
    const HelicopterLawOptions options = with(variant, Law::Mean);
    EXPECT_EQ(velocities(input, options), velocities(other, options));
  }
}

// psi is wrong and the camera at its place: vp3 takes the shift Z* tan(psi) of the image for its
// own, vp3_hh turns and leaves an answer of second order in psi.
TEST(HelicopterLaw, HeadingHoldDoesNotAnswerATurnByATranslation) {
  const Mount mount = forward({0, 0, 0});
  for (const double psi : {0.02, -0.04}) {
    // Turned by psi about down, c_y: the points turn the other way.
    TargetPose view = at_goal();
    const Eigen::Matrix3d R = rotation_from_vector({0, -psi, 0});
    view = {R * view.rotation, R * view.translation};
    HelicopterLawInput input = tilted(view, {}, mount);
    input.heading_rad = psi;
    const Vector6d held = velocities(input, with(Variant::Vp3Hh, Law::Mean));
    const Vector6d fooled = velocities(input, with(Variant::Vp3, Law::Mean));
    // A turn moves a point by (1 + x^2) psi, x^2 = 0.01.
    EXPECT_NEAR(fooled[1], -kGain * 5 * 1.01 * psi, 0.01 * std::abs(psi));
    EXPECT_LT(held.head<3>().norm(), 5 * psi * psi);
    EXPECT_NEAR(held[5], -kGain * psi, 1e-15);
  }
}

TEST(HelicopterLaw, PredictionAnswersWhatTheCameraSeesNow) {
  const Mount mount = forward({0.3, 0, 0.1});
  const TargetPose then{Eigen::Matrix3d::Identity(), {0.4, -0.3, 7}};
  const TargetPose now{Eigen::Matrix3d::Identity(), {0.2, -0.1, 6}};
  for (const Variant variant : {Variant::Vp4, Variant::Vp3Hh, Variant::Vp3, Variant::Raw4}) {
    HelicopterLawInput old = tilted(then, {}, mount);
    old.now_from_then = now * then.inverse();
    for (Feature& f : old.camera.measured) f.depth_m = 3;  // comes from the area
    const HelicopterLawOptions options = with(variant, Law::Cur);
    const Vector6d expected = velocities(tilted(now, {}, mount), options);
    EXPECT_LT((velocities(old, options) - expected).norm(), 1e-10);  // condition 600
  }
}

TEST(HelicopterLaw, PredictionMovesThePosesToo) {
  const TargetPose then{Eigen::Matrix3d::Identity(), {0.4, -0.3, 7}};
  const TargetPose now{Eigen::Matrix3d::Identity(), {0.2, -0.1, 6}};
  const auto told = [](const TargetPose& view) {
    HelicopterLawInput input = tilted(view, {}, forward({0.3, 0, 0.1}));
    const CameraMotion motion = at_goal() * view.inverse();
    input.camera.goal_from_camera = Displacement{motion.rotation, motion.translation};
    input.camera.camera_from_target = view;
    input.camera.goal_from_target = at_goal();
    return input;
  };
  HelicopterLawInput old = told(then);
  old.now_from_then = now * then.inverse();
  const HelicopterLawOptions options = with(Variant::Vp4, Law::PmjT);
  EXPECT_LT((velocities(old, options) - velocities(told(now), options)).norm(), 1e-10);
}

// 592 at 5 m with a 1 m window; what a pixel of noise (f = 600 px, gain 1/s) asks for.
TEST(HelicopterLaw, FourFreedomsOfAForwardCameraAreConfounded) {
  const HelicopterLawInput input = tilted(at_goal(), {}, forward({0.3, 0, 0.1}));
  HelicopterLawOptions options = with(Variant::Vp4, Law::Des);
  options.law.gain = LawGain::constant(1);
  EXPECT_NEAR(helicopter_law(input, options).law.condition, 592.498, 5e-4);
  const auto spread = [&](Variant variant) {
    options.variant = variant;
    Vector6d squares = Vector6d::Zero();
    for (int i = 0; i < 8; ++i) {
      HelicopterLawInput noisy = input;
      ImagePoint& at = noisy.camera.measured[std::size_t(i / 2)].at;
      (i % 2 == 0 ? at.x : at.y) += 1.0 / 600;  // des is linear
      squares += velocities(noisy, options).cwiseAbs2();
    }
    return Vector6d(squares.cwiseSqrt());
  };
  const Vector6d four = spread(Variant::Vp4);
  EXPECT_NEAR(four[1], 0.446, 5e-4);
  EXPECT_NEAR(four[5] * 180 / M_PI, 4.8, 0.05);
  EXPECT_NEAR(spread(Variant::Vp3)[1], 0.0042, 5e-5);
  // drop6 does not tell tilt from height either: 107 times as much downwards; the rest as vp4, but
  // for the lever of 0.1 m by which that tilt moves the camera forward.
  const Vector6d six = spread(Variant::Drop6);
  EXPECT_NEAR(six[0] / four[0], 1.039, 1e-3);
  EXPECT_NEAR(six[1] / four[1], 1, 1e-5);
  EXPECT_NEAR(six[2] / four[2], 107.0, 0.01);
  EXPECT_NEAR(six[5] / four[5], 1, 1e-5);
}

TEST(HelicopterLaw, NonsenseIsARefusalWithItsReason) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const HelicopterLawInput good = tilted(at_goal(), {}, forward({0.3, 0, 0.1}));
  const auto refusal = [](const HelicopterLawInput& input, Variant variant) {
    const HelicopterLawAnswer answer = helicopter_law(input, with(variant, Law::Mean));
    EXPECT_FALSE(answer.twist);
    return answer.refusal;
  };
  for (const Variant variant : all_helicopter_variants()) {
    HelicopterLawInput input = good;
    input.attitude.pitch = nan;
    EXPECT_EQ(refusal(input, variant), LawRefusal::NotFinite);
    input = good;
    input.heading_rad = nan;
    EXPECT_EQ(refusal(input, variant), LawRefusal::NotFinite);
    input = good;
    input.body_from_camera.rotation *= 2;
    EXPECT_EQ(refusal(input, variant), LawRefusal::Unreachable);
    input = good;
    input.camera.measured[0].at.x = nan;
    EXPECT_EQ(refusal(input, variant), LawRefusal::NotFinite);
    input = good;
    input.camera.measured.pop_back();
    EXPECT_EQ(refusal(input, variant), LawRefusal::Unequal);
    input = good;
    input.now_from_then = CameraMotion{Eigen::Matrix3d::Identity(), {0, 0, -6}};
    EXPECT_EQ(refusal(input, variant), LawRefusal::Singular);
  }
}

// What the law inside refuses, whatever law and variant: with its reason, and no twist.
TEST(HelicopterLaw, NonsenseOfTheImageIsARefusalOfEveryLaw) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  HelicopterLawInput good;
  good.camera = test::input_at(test::kS1);
  good.body_from_camera = forward({0.3, 0, 0.1});
  const auto on_a_line = [](std::vector<Feature>& points) {
    for (int i = 0; i < 4; ++i) points[std::size_t(i)] = {{0.1 * i - 0.15, 0.05 * i}, 1};
  };
  using Change = std::function<void(LawInput&)>;
  const std::vector<std::pair<LawRefusal, Change>> broken = {
      {LawRefusal::FewPoints, [](LawInput& in) { in.measured.resize(2), in.desired.resize(2); }},
      {LawRefusal::NotFinite, [&](LawInput& in) { in.measured[2].at.y = nan; }},
      {LawRefusal::Depth, [&](LawInput& in) { in.desired[1].depth_m = nan; }},
      {LawRefusal::Depth, [](LawInput& in) { in.measured[1].depth_m = 0; }},
      {LawRefusal::Depth, [](LawInput& in) { in.measured[3].depth_m = -1; }},
      {LawRefusal::Coincident, [](LawInput& in) { in.measured.assign(4, in.measured[0]); }},
      {LawRefusal::Coincident, [](LawInput& in) { in.desired.assign(4, in.desired[0]); }},
      {LawRefusal::Collinear, [&](LawInput& in) { on_a_line(in.measured); }},
      {LawRefusal::Collinear, [&](LawInput& in) { on_a_line(in.desired); }}};
  for (const Variant variant : all_helicopter_variants()) {
    for (const Law law : all_laws()) {
      for (const auto& [refusal, change] : broken) {
        HelicopterLawInput input = good;
        change(input.camera);
        HelicopterLawOptions options = with(variant, law);
        options.law.max_condition = std::numeric_limits<double>::infinity();
        const HelicopterLawAnswer answer = helicopter_law(input, options);
        EXPECT_FALSE(answer.twist) << name(variant) << ' ' << name(law);
        EXPECT_EQ(answer.refusal, refusal) << name(variant) << ' ' << name(law);
      }
    }
  }
}

TEST(HelicopterLaw, OptionsAreChecked) {
  HelicopterLawOptions options;
  EXPECT_NO_THROW(options.check());
  options.heading_gain_per_s = -1;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.law.rank_tolerance = -1;
  EXPECT_THROW(options.check(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

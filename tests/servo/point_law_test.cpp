#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "kestrel/servo/control_law.hpp"

#include "servo/law_bench.hpp"
#include "servo/oracle.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

using test::MatrixXr;
using test::solved;
using test::VectorXr;

constexpr Law kPointLaws[] = {Law::Cur,         Law::CurZdes, Law::CurZarea, Law::CurZhomog,
                              Law::Des,         Law::Mean,    Law::MeanZdes, Law::Mjp,
                              Law::PmjR,        Law::PmjT,    Law::Lm,       Law::Transpose,
                              Law::TransposeRaw};

// Six digits are printed in the tutorial's table of first answers.
TEST(PointLaw, AnswersTheFirstTwistsOfTheTutorial) {
  const std::map<Law, std::array<double, 6>> printed = {
      {Law::Cur, {.020066, -.089513, -.127833, .150247, .002328, 1.031707}},
      {Law::Des, {.199569, -.131016, .402333, -.071201, -.114750, .581608}},
      {Law::Mean, {.378162, .004703, .268493, .188034, -.311916, .903438}},
      {Law::Mjp, {.109818, -.110265, .137250, .039523, -.056211, .806658}}};
  for (const auto& [law, twist] : printed) {
    const Vector6d v = test::twist_at(test::kS0, law);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(v[i], twist[std::size_t(i)], 6e-7) << name(law) << i;
  }
  // The homography knows the depths: no approximation is left.
  EXPECT_LT(
      (test::twist_at(test::kS0, Law::CurZhomog) - test::twist_at(test::kS0, Law::Cur)).norm(),
      1e-12);
}

TEST(PointLaw, EndsWhereTheTutorialEnds) {
  const std::map<Law, double> printed = {
      {Law::Cur, 2.253876834e-02}, {Law::Des, 3.406660226e-02}, {Law::Mean, 2.868349185e-02}};
  EXPECT_NEAR(test::error_at(test::kS0), .469108342, 6e-10);
  for (const auto& [law, error] : printed) {
    LawOptions options = test::unit_options(law);
    options.gain = LawGain::constant(0.5);
    const TargetPose end = test::fly(test::kS0, options, 150, 0.04);
    EXPECT_NEAR(test::error_at(end), error, 6e-12) << name(law);  // printed to 1e-11
  }
}

const Vector6d kAway = (Vector6d() << .20, -.15, .25, .35, -.25, .60).finished();

/// |v + xi| when the camera is exp(xi) away from the goal: what the law misses of the screw.
double miss(Law law, double size) {
  const Vector6d xi = kAway * size;
  const Displacement cdMc = exponential(xi, 1);
  return (test::twist_at(test::seen_from(cdMc), law) + xi).norm();
}

/// The same against the twist of the straight way: R^T t and the rotation vector.
double miss_of_the_line(Law law, double size) {
  const Displacement cdMc = exponential(kAway * size, 1);
  Vector6d line;
  line << cdMc.rotation.transpose() * cdMc.translation, rotation_vector(cdMc.rotation);
  return (test::twist_at(test::seen_from(cdMc), law) + line).norm();
}

// Malis 2004, Tahri & Mezouar 2010: means are right to second order, the others to first.
TEST(PointLaw, HasTheOrderOfItsMatrix) {
  const auto slope = [](Law law, double coarse, auto of) {
    return std::log2(of(law, coarse) / of(law, coarse / 2));
  };
  const std::map<Law, double> fine = {{Law::Cur, 1.995}, {Law::Des, 2.004},  {Law::Mean, 2.994},
                                      {Law::Mjp, 3.002}, {Law::PmjT, 2.994}, {Law::PmjR, 1.999}};
  for (const auto& [law, printed] : fine) {
    EXPECT_NEAR(slope(law, .0125, miss), printed, 6e-4) << name(law);
  }
  EXPECT_NEAR(slope(Law::PmjR, .0125, miss_of_the_line), 2.992, 6e-4);
  const std::map<Law, double> coarse = {
      {Law::MeanZdes, 2.10}, {Law::CurZdes, 1.94}, {Law::CurZarea, 1.94}};
  for (const auto& [law, printed] : coarse) {
    EXPECT_NEAR(slope(law, .05, miss), printed, 6e-3) << name(law);
  }
}

// A target parallel to the image, twice as far as at the goal: the camera starts at a speed that is
// a factor times gain and way, the factor a function of zeta = Z / Z* = 2.
TEST(PointLaw, StartsATranslationWithItsFactor) {
  const double zeta = 2;
  const Eigen::Vector3d way(-.5, .3, .75);
  const std::map<Law, double> factors = {{Law::Cur, zeta},
                                         {Law::CurZarea, zeta},
                                         {Law::CurZhomog, zeta},
                                         {Law::CurZdes, 1},
                                         {Law::Des, 1 / zeta},
                                         {Law::Mean, 2 / (zeta + 1 / zeta)},
                                         {Law::PmjR, 2 / (zeta + 1 / zeta)},
                                         {Law::Mjp, (zeta + 1 / zeta) / 2},
                                         {Law::MeanZdes, 2 / (1 + zeta)}};
  const TargetPose pose = test::seen_from(test::displacement(-way, {0, 0, 0}));
  for (const auto& [law, factor] : factors) {
    const Vector6d v = test::twist_at(pose, law);
    EXPECT_LT((v.head<3>() - factor * way).norm(), 1e-12) << name(law);
    EXPECT_LT(v.tail<3>().norm(), 1e-12) << name(law);
  }
  const std::map<Law, double> printed = {{Law::Cur, 1.900}, {Law::CurZdes, .950},
                                         {Law::Des, .475},  {Law::Mean, .760},
                                         {Law::Mjp, 1.188}, {Law::MeanZdes, .633}};
  for (const auto& [law, speed] : printed) {
    EXPECT_NEAR(test::twist_at(test::kS8, law).head<3>().norm(), speed, 6e-4) << name(law);
  }
}

// About the optical axis, in closed form: who turns how fast, and who flies back or forth.
TEST(PointLaw, TurnsAboutTheAxisInClosedForm) {
  for (const double deg : {-150., -45., 10., 45., 90., 135., 160., 179.}) {
    const double th = deg * M_PI / 180;
    const auto expect = [&](Law law, double forward, double turn) {
      const Vector6d v = test::twist_at(test::turned_about_axis(deg), law);
      Vector6d expected = Vector6d::Zero();
      expected[2] = forward;
      expected[5] = turn;
      // Rounding times the condition of the mean, which grows with tan(th/2).
      EXPECT_LT((v - expected).norm(), 1e-11 * (1 + std::abs(std::tan(th / 2))))
          << name(law) << ' ' << deg;
    };
    expect(Law::Cur, -.75 * (1 - std::cos(th)), -std::sin(th));
    expect(Law::Des, .75 * (1 - std::cos(th)), -std::sin(th));
    expect(Law::Mean, 0, -2 * std::tan(th / 2));
    expect(Law::Mjp, 0, -std::sin(th));
  }
  // At 180 degrees the current matrix flies backwards without turning; the mean one is singular.
  const Vector6d back = test::twist_at(test::turned_about_axis(180), Law::Cur);
  EXPECT_NEAR(back[2], -2 * .75, 1e-12);
  EXPECT_NEAR(back[5], 0, 1e-12);
  LawOptions flight = test::unit_options(Law::Mean);
  flight.max_condition = 1e4;
  EXPECT_EQ(control_law(test::input_at(test::turned_about_axis(180)), flight).refusal,
            LawRefusal::Singular);
}

TEST(PointLaw, KnowsTheSingularValuesOfTheGoal) {
  const double printed[] = {3.354857, 3.354857, .502831, .377124, .028262, .028262};
  for (const Law law : {Law::Cur, Law::Des, Law::Mean, Law::Mjp, Law::PmjT, Law::Lm}) {
    const LawAnswer answer = control_law(test::input_at(test::kBenchGoal), test::unit_options(law));
    ASSERT_EQ(answer.singular_values.size(), 6) << name(law);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(answer.singular_values[i], printed[i], 6e-7);
    EXPECT_NEAR(answer.condition, 118.7057, 6e-5);
    EXPECT_NEAR(answer.smallest_singular_value, printed[5], 6e-7);
    EXPECT_EQ(answer.rank, 6);
  }
}

// A depth k times too large multiplies the translation and leaves the rotation.
TEST(PointLaw, AnswersAFactorOfTheDepthsWithTheTranslation) {
  for (const double k : {0.25, 0.5, 2., 4.}) {
    LawInput input = test::input_at(test::kS0);
    for (Feature& f : input.measured) f.depth_m *= k;
    const Vector6d v = control_law(input, test::unit_options(Law::Cur)).twist->vector();
    Vector6d expected = test::twist_at(test::kS0, Law::Cur);
    expected.head<3>() *= k;
    EXPECT_LT((v - expected).norm(), 1e-12);
  }
}

/// The laws written again in long double, by QR and normal equations.
struct Case {
  std::vector<Feature> measured;
  std::vector<Feature> desired;
  Displacement goal_from_camera;
  MatrixXr B;
};

MatrixXr oracle_move(const Displacement& step, Law law) {
  const test::Matrix3r R = step.rotation.cast<test::Real>();
  MatrixXr V = MatrixXr::Zero(6, 6);
  for (int i = 0; i < 3; ++i) {
    V.block<3, 1>(0, i) = R.col(i);
    V.block<3, 1>(3, 3 + i) = R.col(i);
    if (law == Law::PmjT) {
      V.block<3, 1>(0, 3 + i) = step.translation.cast<test::Real>().cross(R.col(i));
    }
  }
  return V;
}

std::vector<Feature> with_depths(std::vector<Feature> points, const std::vector<Feature>& from) {
  for (std::size_t i = 0; i < points.size(); ++i) points[i].depth_m = from[i].depth_m;
  return points;
}

/// Area of a convex quadrangle by two triangles.
double area(const std::vector<Feature>& p) {
  const auto triangle = [&](int a, int b, int c) {
    const Eigen::Vector2d u(p[std::size_t(b)].at.x - p[std::size_t(a)].at.x,
                            p[std::size_t(b)].at.y - p[std::size_t(a)].at.y);
    const Eigen::Vector2d v(p[std::size_t(c)].at.x - p[std::size_t(a)].at.x,
                            p[std::size_t(c)].at.y - p[std::size_t(a)].at.y);
    return std::abs(u.x() * v.y() - u.y() * v.x()) / 2;
  };
  return triangle(0, 1, 2) + triangle(0, 2, 3);
}

VectorXr oracle(const Case& c, Law law, const LawOptions& options) {
  const MatrixXr goal = test::oracle_interaction(c.desired) * c.B;
  const MatrixXr now = test::oracle_interaction(c.measured) * c.B;
  const MatrixXr zdes = test::oracle_interaction(with_depths(c.measured, c.desired)) * c.B;
  const VectorXr e = (test::stacked(c.measured) - test::stacked(c.desired)).cast<test::Real>();
  const MatrixXr normal = now.transpose() * now;
  switch (law) {
    case Law::CurZdes:
      return solved(zdes, e);
    case Law::CurZarea: {
      double mean_m = 0;
      for (const Feature& f : c.desired) mean_m += f.depth_m / 4;
      std::vector<Feature> seen = c.measured;
      for (Feature& f : seen) f.depth_m = mean_m * std::sqrt(area(c.desired) / area(c.measured));
      return solved(test::oracle_interaction(seen) * c.B, e);
    }
    case Law::Des:
      return solved(goal, e);
    case Law::Mean:
      return solved((now + goal) / 2, e);
    case Law::MeanZdes:
      return solved((zdes + goal) / 2, e);
    case Law::Mjp:
      return (solved(now, e) + solved(goal, e)) / 2;
    case Law::PmjR:
    case Law::PmjT:
      return solved(
          (now + test::oracle_interaction(c.desired) * oracle_move(c.goal_from_camera, law) * c.B) /
              2,
          e);
    case Law::Lm: {
      MatrixXr damped = normal;
      for (int i = 0; i < damped.rows(); ++i) damped(i, i) *= 1 + test::Real(options.damping);
      return solved(damped, now.transpose() * e);
    }
    case Law::Transpose: {
      const VectorXr values = test::singular_values(now);
      return now.transpose() * e / (values[0] * values[0]);
    }
    case Law::TransposeRaw:
      return now.transpose() * e;
    default:
      return solved(now, e);
  }
}

TEST(PointLaw, IsTheLawOfThePapersInAnyBasis) {
  test::Random random("point law");
  for (int i = 0; i < 40; ++i) {
    const TargetPose goal{rotation_from_vector(random.rotation_vector(0.4)),
                          random.vector3(0.2) + Eigen::Vector3d(0, 0, 1.2)};
    const TargetPose pose{rotation_from_vector(random.rotation_vector(0.4)),
                          random.vector3(0.2) + Eigen::Vector3d(0, 0, 1.4)};
    const auto cdMc = goal * pose.inverse();
    LawInput input;
    input.measured = features(pose, test::square(0.3));
    input.desired = features(goal, test::square(0.3));
    input.goal_from_camera = Displacement{cdMc.rotation, cdMc.translation};
    const Eigen::Vector3d n_in_goal = goal.rotation.col(2);
    input.camera_from_goal_homography =
        -3 * (cdMc.inverse().rotation +
              cdMc.inverse().translation * n_in_goal.transpose() / n_in_goal.dot(goal.translation));
    const Mount mount = test::forward_mount(random.vector3(0.3));
    const Freedom freedom = i % 3 == 0 ? Freedom::Six : i % 3 == 1 ? Freedom::Four : Freedom::Three;
    const MatrixXr B = test::oracle_basis(mount, freedom);
    if (i % 6 != 0) input.basis = B.cast<double>();
    const Case c{input.measured, input.desired, *input.goal_from_camera,
                 i % 6 != 0 ? B : MatrixXr(MatrixXr::Identity(6, 6))};
    for (const Law law : kPointLaws) {
      LawOptions options = test::unit_options(law);
      options.gain = LawGain::constant(0.7);
      const LawAnswer answer = control_law(input, options);
      ASSERT_TRUE(answer.twist) << name(law) << name(answer.refusal);
      const Vector6d expected = (test::Real(-0.7) * c.B * oracle(c, law, options)).cast<double>();
      // Rounding times the condition, for lm its square.
      const double slack = law == Law::Lm ? 1e-10 : 1e-12;
      EXPECT_LT((answer.twist->vector() - expected).norm(), slack * (1 + expected.norm()))
          << name(law) << ' ' << i;
      EXPECT_EQ(answer.gain_per_s, 0.7);
      EXPECT_EQ(answer.error.size(), 8);
    }
  }
}

// Three points, five, twelve: any number is least squares.
TEST(PointLaw, TakesThreePointsOrMore) {
  test::Random random("point law count");
  for (const int count : {3, 5, 12}) {
    LawInput input;
    for (int i = 0; i < count; ++i) {
      const double x = std::cos(2.4 * i) * 0.3;  // spread over a circle
      const double y = std::sin(2.4 * i) * 0.3;
      input.desired.push_back({{x, y}, random.uniform(1, 2)});
      input.measured.push_back(
          {{x + random.uniform(-0.1, 0.1), y + random.uniform(-0.1, 0.1)}, 1.5});
    }
    const MatrixXr L = test::oracle_interaction(input.measured);
    const VectorXr e =
        (test::stacked(input.measured) - test::stacked(input.desired)).cast<test::Real>();
    const Vector6d expected = -solved(L, e).cast<double>();
    const LawAnswer answer = control_law(input, test::unit_options(Law::Cur));
    ASSERT_TRUE(answer.twist);
    EXPECT_LT((answer.twist->vector() - expected).norm(), 1e-11 * expected.norm()) << count;
  }
}

// Directions whose singular value is below the tolerance are left alone, as vpServo does.
TEST(PointLaw, LeavesAloneWhatItHardlySees) {
  LawInput input = test::input_at(test::kS0);
  LawOptions options = test::unit_options(Law::Des);
  options.rank_tolerance = 0.05;  // between .028262 / 3.354857 and .377124 / 3.354857
  const LawAnswer answer = control_law(input, options);
  EXPECT_EQ(answer.rank, 4);
  const Eigen::MatrixXd L = test::oracle_interaction(input.desired).cast<double>();
  EXPECT_LT((answer.twist->vector() + test::solved(L, answer.error, 0.05)).norm(), 1e-13);
  options.solver = LawSolver::Visp;
  EXPECT_LT((answer.twist->vector() - control_law(input, options).twist->vector()).norm(), 1e-13);
}

}  // namespace
}  // namespace kestrel

#include "kestrel/servo/control_law.hpp"

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "servo/law_bench.hpp"

namespace kestrel {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

LawRefusal refusal(const LawInput& input, Law law) {
  const LawAnswer answer = control_law(input, test::unit_options(law));
  EXPECT_EQ(answer.twist.has_value(), answer.refusal == LawRefusal::None) << name(law);
  return answer.refusal;
}

class LawOfNonsense : public testing::TestWithParam<Law> {
 protected:
  LawInput good_ = test::input_at(test::kS1);
};

TEST_P(LawOfNonsense, NeedsPointsInEqualNumber) {
  good_.measured.pop_back();
  EXPECT_EQ(refusal(good_, GetParam()), LawRefusal::Unequal);
  for (const std::size_t count : {2u, 1u, 0u}) {
    good_.measured.resize(count);
    good_.desired.resize(count);
    EXPECT_EQ(refusal(good_, GetParam()), LawRefusal::FewPoints);
  }
}

TEST_P(LawOfNonsense, NeedsNumbers) {
  for (const double bad : {kNan, kInf, -kInf, 1e300}) {
    for (int field = 0; field < 10; ++field) {
      LawInput broken = good_;
      if (field == 0) broken.measured[1].at.x = bad;
      if (field == 1) broken.desired[2].at.y = bad;
      if (field == 2) broken.goal_from_camera->rotation(1, 1) = bad;
      if (field == 3) broken.goal_from_camera->translation.x() = bad;
      if (field == 4) broken.camera_from_target->rotation(0, 2) = bad;
      if (field == 5) broken.goal_from_target->translation.z() = bad;
      if (field == 6) (*broken.camera_from_goal_homography)(2, 0) = bad;
      if (field == 7) broken.camera_motion = Vector6d::Constant(bad);
      if (field == 8) broken.basis = Matrix6d::Constant(bad);
      if (field == 9) broken.time_s = std::isfinite(bad) ? kNan : bad;
      EXPECT_EQ(refusal(broken, GetParam()), LawRefusal::NotFinite) << field;
    }
  }
}

TEST_P(LawOfNonsense, NeedsPointsInFrontOfTheCamera) {
  for (const double depth : {0., -0., 9e-7, -1.}) {
    LawInput broken = good_;
    broken.measured[3].depth_m = depth;
    EXPECT_EQ(refusal(broken, GetParam()), LawRefusal::Depth) << depth;
    broken = good_;
    broken.desired[0].depth_m = depth;
    EXPECT_EQ(refusal(broken, GetParam()), LawRefusal::Depth) << depth;
  }
  good_.desired[0].depth_m = kNan;  // Z* is no secret
  EXPECT_EQ(refusal(good_, GetParam()), LawRefusal::Depth);
}

TEST_P(LawOfNonsense, NeedsThreePlaces) {
  LawInput broken = good_;
  broken.measured[1] = broken.measured[0];
  broken.measured[3] = broken.measured[2];
  EXPECT_EQ(refusal(broken, GetParam()), LawRefusal::Coincident);
  broken = good_;
  broken.desired.assign(4, broken.desired[0]);
  EXPECT_EQ(refusal(broken, GetParam()), LawRefusal::Coincident);
}

// On a line to rounding: refused however ill conditioned the law's matrix may be.
TEST_P(LawOfNonsense, NeedsPointsThatAreNotOnALine) {
  for (const bool is_desired : {false, true}) {
    for (const double off : {0.0, 1e-9}) {
      LawInput broken = good_;
      std::vector<Feature>& points = is_desired ? broken.desired : broken.measured;
      for (int i = 0; i < 4; ++i) {
        points[std::size_t(i)] = {{0.1 * i - 0.15, 0.05 * i + off * i * i}, 1};
      }
      for (const double largest : {1e4, kInf}) {
        LawOptions options = test::unit_options(GetParam());
        options.max_condition = largest;
        const LawAnswer answer = control_law(broken, options);
        EXPECT_FALSE(answer.twist) << off;
        EXPECT_EQ(answer.refusal, LawRefusal::Collinear) << off;
      }
    }
  }
}

// Measured and desired coincide: there is nothing to do, and no law makes anything of rounding.
TEST_P(LawOfNonsense, StandsStillWhereMeasuredAndDesiredCoincide) {
  const LawAnswer answer =
      control_law(test::input_at(test::kBenchGoal), test::unit_options(GetParam()));
  ASSERT_TRUE(answer.twist) << name(answer.refusal);
  EXPECT_LT(answer.twist->vector().norm(), 1e-13);
}

TEST_P(LawOfNonsense, HasNoTwistWithoutABasis) {
  good_.basis = TwistBasis::Zero(6, 4);
  EXPECT_EQ(refusal(good_, GetParam()), LawRefusal::Unreachable);
}

TEST_P(LawOfNonsense, KeepsItsStateWhenItRefuses) {
  LawState state;
  state.features = Eigen::VectorXd::Constant(8, 0.25);
  state.first_twist = Vector6d::Ones();
  good_.measured.clear();
  const LawAnswer answer = control_law(good_, test::unit_options(GetParam()), state);
  EXPECT_EQ(answer.next.features, state.features);
  EXPECT_EQ(answer.next.first_twist, state.first_twist);
}

INSTANTIATE_TEST_SUITE_P(EveryLaw, LawOfNonsense, testing::ValuesIn(all_laws()));

constexpr Law kMatrixLaws[] = {Law::Cur,          Law::CurZdes, Law::CurZarea,   Law::CurZhomog,
                               Law::Des,          Law::Mean,    Law::MeanZdes,   Law::Mjp,
                               Law::PmjR,         Law::PmjT,    Law::Lm,         Law::Transpose,
                               Law::TransposeRaw, Law::Broyden, Law::BroydenRaw, Law::Rls};

// Nearly on a line: the twist about the line is not seen, and must not be guessed.
TEST(ControlLaw, NamesPointsOnALine) {
  for (const double off : {1e-6, 1e-5}) {
    LawInput input = test::input_at(test::kS1);
    for (int i = 0; i < 4; ++i) {
      input.measured[std::size_t(i)] = {{0.1 * i - 0.15, 0.05 * i + off * i * i}, 1};
      input.desired[std::size_t(i)] = {{0.1 * i - 0.14, 0.05 * i + off * i * i}, 1};
    }
    for (const Law law : kMatrixLaws) {
      LawOptions options = test::unit_options(law);
      options.max_condition = 1e4;
      const LawAnswer answer = control_law(input, options);
      EXPECT_FALSE(answer.twist) << name(law) << off;
      EXPECT_EQ(answer.refusal, LawRefusal::Collinear) << name(law) << off;
      // With no limit the pseudo-inverse answers what it sees, with numbers.
      if (law == Law::CurZarea || law == Law::CurZhomog) continue;  // they see an area
      options.max_condition = kInf;
      const LawAnswer lab = control_law(input, options);
      ASSERT_TRUE(lab.twist) << name(law) << off;
      EXPECT_TRUE(lab.twist->vector().allFinite());
      EXPECT_LT(lab.twist->vector().norm(), 1e3);
    }
  }
}

// Three points are singular on the cylinder through them (Michel & Rives 1993): here the optical
// centre is straight above their circle.
TEST(ControlLaw, NamesASingularConfiguration) {
  LawInput input;
  input.measured = {{{.2, .2}, 1}, {{.2, -.2}, 1}, {{.4, 0}, 1}};  // circle about (.2, 0)
  input.desired = input.measured;
  LawOptions options = test::unit_options(Law::Cur);
  options.max_condition = 1e4;
  const LawAnswer answer = control_law(input, options);
  EXPECT_EQ(answer.refusal, LawRefusal::Singular) << answer.condition;
  EXPECT_FALSE(answer.twist);
  EXPECT_EQ(answer.rank, 5);
}

TEST(ControlLaw, SaysWhatItsLawIsMissing) {
  LawInput input = test::input_at(test::kS1);
  input.goal_from_camera.reset();
  EXPECT_EQ(refusal(input, Law::PmjR), LawRefusal::Pose);
  EXPECT_EQ(refusal(input, Law::PmjT), LawRefusal::Pose);
  input.goal_from_camera = Displacement{1.1 * Eigen::Matrix3d::Identity(), {0, 0, 0}};
  EXPECT_EQ(refusal(input, Law::PmjT), LawRefusal::Pose);
  input.camera_from_goal_homography.reset();
  EXPECT_EQ(refusal(input, Law::CurZhomog), LawRefusal::Homography);
  input.camera_from_goal_homography = Eigen::Matrix3d::Zero();
  EXPECT_EQ(refusal(input, Law::CurZhomog), LawRefusal::Homography);
  // The plane would be seen from both sides.
  input.camera_from_goal_homography = Eigen::Vector3d(1, 1, 0).asDiagonal();
  (*input.camera_from_goal_homography)(2, 0) = 10;
  EXPECT_EQ(refusal(input, Law::CurZhomog), LawRefusal::Homography);
}

// A law that does not use the measured depths works without.
TEST(ControlLaw, TakesUnknownDepthsWhereItCan) {
  LawInput input = test::input_at(test::kS1);
  for (Feature& f : input.measured) f.depth_m = kNan;
  const std::set<Law> depth_free = {Law::CurZdes,  Law::CurZarea, Law::CurZhomog,  Law::Des,
                                    Law::MeanZdes, Law::Broyden,  Law::BroydenRaw, Law::Rls};
  for (const Law law : kMatrixLaws) {
    EXPECT_EQ(refusal(input, law), depth_free.count(law) ? LawRefusal::None : LawRefusal::Depth)
        << name(law);
  }
}

TEST(ControlLaw, StandsStillAtTheGoal) {
  for (const Law law : kMatrixLaws) {
    for (const LawSolver solver : {LawSolver::Eigen, LawSolver::Visp}) {
      LawOptions options = test::unit_options(law);
      options.solver = solver;
      options.gain = {2, 0.5, 1};
      const LawAnswer answer = control_law(test::input_at(test::kBenchGoal), options);
      ASSERT_TRUE(answer.twist) << name(law);
      EXPECT_EQ(answer.twist->vector(), Vector6d::Zero()) << name(law);
    }
  }
}

TEST(ControlLaw, GivesTheSameBitsInAnyThread) {
  for (const Law law : all_laws()) {
    const LawAnswer here = control_law(test::input_at(test::kS0), test::unit_options(law));
    LawAnswer there;
    std::thread([&] {
      there = control_law(test::input_at(test::kS0), test::unit_options(law));
    }).join();
    ASSERT_EQ(here.twist.has_value(), there.twist.has_value());
    if (!here.twist) continue;
    EXPECT_EQ(here.twist->vector(), there.twist->vector()) << name(law);
  }
}

// With vpServo behind it, from many threads at a time.
TEST(ControlLaw, LetsThreadsShareVisp) {
  LawOptions options = test::unit_options(Law::Mean);
  options.solver = LawSolver::Visp;
  const Vector6d expected = test::twist_at(test::kS0, Law::Mean);
  std::vector<std::thread> threads;
  std::array<double, 4> worst{};
  for (double& largest : worst) {
    threads.emplace_back([&] {
      for (int k = 0; k < 200; ++k) {
        const LawAnswer answer = control_law(test::input_at(test::kS0), options);
        largest = std::max(largest, (answer.twist->vector() - expected).norm());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const double largest : worst) EXPECT_LT(largest, 1e-12);
}

TEST(ControlLaw, EveryRefusalAndSolverHasAName) {
  std::set<std::string> names;
  for (int i = 0; i <= int(LawRefusal::Unreachable); ++i) names.insert(name(LawRefusal(i)));
  EXPECT_EQ(names.size(), std::size_t(LawRefusal::Unreachable) + 1);
  EXPECT_EQ(names.count("unknown"), 0u);
  EXPECT_STREQ(name(LawSolver::Eigen), "eigen");
  EXPECT_STREQ(name(LawSolver::Visp), "visp");
}

std::string error_of(const LawOptions& options) {
  try {
    options.check();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(LawOptions, NameTheOptionOutOfRange) {
  EXPECT_EQ(error_of({}), "");
  const auto with = [](auto change) {
    LawOptions options;
    change(options);
    return error_of(options);
  };
  using testing::StartsWith;
  for (const double bad : {0., -1., kNan, kInf}) {
    EXPECT_THAT(with([&](LawOptions& o) { o.gain.at_zero_per_s = bad; }),
                StartsWith("gain.at_zero_per_s: must be"));
    EXPECT_THAT(with([&](LawOptions& o) { o.gain.at_infinity_per_s = bad; }),
                StartsWith("gain.at_infinity_per_s: must be"));
    EXPECT_THAT(with([&](LawOptions& o) { o.initial_covariance = bad; }),
                StartsWith("initial_covariance: must be"));
  }
  EXPECT_THAT(with([&](LawOptions& o) { o.gain.at_infinity_per_s = 0.6; }),
              StartsWith("gain.at_infinity_per_s: must be"));
  for (const double bad : {-1e-9, kNan, kInf}) {
    EXPECT_THAT(with([&](LawOptions& o) { o.gain.slope_at_zero_per_s = bad; }),
                StartsWith("gain.slope_at_zero_per_s: must be"));
    EXPECT_THAT(with([&](LawOptions& o) { o.smooth_start_per_s = bad; }),
                StartsWith("smooth_start_per_s: must be"));
    EXPECT_THAT(with([&](LawOptions& o) { o.damping = bad; }), StartsWith("damping: must be"));
    EXPECT_THAT(with([&](LawOptions& o) { o.learning_gate = bad; }),
                StartsWith("learning_gate: must be"));
  }
  for (const double bad : {0., 1.01, kNan}) {
    EXPECT_THAT(with([&](LawOptions& o) { o.forgetting = bad; }),
                StartsWith("forgetting: must be"));
  }
  for (const double bad : {-1e-9, 1., kNan}) {
    EXPECT_THAT(with([&](LawOptions& o) { o.rank_tolerance = bad; }),
                StartsWith("rank_tolerance: must be"));
  }
  for (const double bad : {0.99, -kInf, kNan}) {
    EXPECT_THAT(with([&](LawOptions& o) { o.max_condition = bad; }),
                StartsWith("max_condition: must be"));
  }
  EXPECT_EQ(with([&](LawOptions& o) { o.max_condition = kInf; }), "");
}

}  // namespace
}  // namespace kestrel

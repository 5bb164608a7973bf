// The laws against ViSP's own vpServo, used as its tutorials use it.
#include <cmath>

#include <gtest/gtest.h>
#include <visp3/core/vpExponentialMap.h>
#include <visp3/visual_features/vpFeaturePoint.h>
#include <visp3/vs/vpAdaptiveGain.h>
#include <visp3/vs/vpServo.h>

#include "kestrel/servo/control_law.hpp"

#include "servo/law_bench.hpp"

namespace kestrel {
namespace {

constexpr Law kVispLaws[] = {Law::Cur, Law::Des, Law::Mean};

double largest_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() == b.size() ? (a - b).cwiseAbs().maxCoeff() : INFINITY;
}

/// A run of 1500 steps at 30 Hz, kept.
std::vector<test::Moment> run_of(const TargetPose& start, Law law, LawSolver solver) {
  LawOptions options = test::unit_options(law);
  options.solver = solver;
  std::vector<test::Moment> moments;
  test::fly(start, options, 1500, 1. / 30, [&](const test::Moment& m) { moments.push_back(m); });
  return moments;
}

// Whole runs, each steered by its own solver: from the same start they stay together.
TEST(LawAgainstVisp, WholeRunsAgree) {
  for (const TargetPose& start : {test::kS0, test::kS1, test::kS3, test::kS5, test::kS8}) {
    for (const Law law : kVispLaws) {
      const auto eigen = run_of(start, law, LawSolver::Eigen);
      const auto visp = run_of(start, law, LawSolver::Visp);
      ASSERT_EQ(eigen.size(), visp.size());
      ASSERT_GT(eigen.size(), 10u);  // des from 160 degrees flies into the target at once
      double error = 0;
      double twist = 0;
      double condition = 0;
      for (std::size_t k = 0; k < eigen.size(); ++k) {
        ASSERT_TRUE(eigen[k].answer.twist && visp[k].answer.twist);
        error = std::max(error, largest_difference(eigen[k].answer.error, visp[k].answer.error));
        twist = std::max(twist, largest_difference(eigen[k].answer.twist->vector(),
                                                   visp[k].answer.twist->vector()));
        condition = std::max(condition, eigen[k].answer.condition);
      }
      EXPECT_LT(error, 1e-12) << name(law);
      // The condition multiplies the rounding of the two; cur from 160 degrees retreats to 4 m.
      EXPECT_LT(twist, 1e-12 * std::max(1., condition / 1000)) << name(law) << ' ' << condition;
    }
  }
}

// On the way of each run: the law by complete orthogonal decomposition, in long double.
TEST(LawAgainstVisp, WholeRunsAgreeWithTheOracle) {
  for (const TargetPose& start : {test::kS0, test::kS1, test::kS3, test::kS5, test::kS8}) {
    for (const Law law : kVispLaws) {
      const auto moments = run_of(start, law, LawSolver::Eigen);
      for (std::size_t k = 0; k < moments.size(); k += 25) {
        const LawInput& input = moments[k].input;
        test::MatrixXr L =
            test::oracle_interaction(law == Law::Des ? input.desired : input.measured);
        if (law == Law::Mean) L = (L + test::oracle_interaction(input.desired)) / 2;
        const test::VectorXr e =
            (test::stacked(input.measured) - test::stacked(input.desired)).cast<test::Real>();
        const Vector6d expected = -L.completeOrthogonalDecomposition().solve(e).cast<double>();
        EXPECT_LT(largest_difference(moments[k].answer.twist->vector(), expected), 1e-12)
            << name(law) << ' ' << k;
      }
    }
  }
}

/// vpServo as in ViSP's tutorial: features updated in place, one task for the whole run.
class Tutorial {
 public:
  explicit Tutorial(const LawInput& first) {
    task_.setServo(vpServo::EYEINHAND_CAMERA);
    task_.setInteractionMatrixType(vpServo::CURRENT);
    for (std::size_t i = 0; i < 4; ++i) {
      set(desired_[i], first.desired[i]);
      task_.addFeature(seen_[i], desired_[i]);
    }
  }
  ~Tutorial() { task_.kill(); }
  Tutorial(const Tutorial&) = delete;
  Tutorial& operator=(const Tutorial&) = delete;

  vpServo& task() { return task_; }
  void see(const LawInput& input) {
    for (std::size_t i = 0; i < 4; ++i) set(seen_[i], input.measured[i]);
  }
  static Vector6d twist(const vpColVector& v) { return Eigen::Map<const Vector6d>(v.data); }

 private:
  static void set(vpFeaturePoint& point, const Feature& f) {
    point.buildFrom(f.at.x, f.at.y, f.depth_m);
  }
  std::array<vpFeaturePoint, 4> seen_;
  std::array<vpFeaturePoint, 4> desired_;
  vpServo task_;
};

// vpAdaptiveGain with its usual numbers.
TEST(LawAgainstVisp, AdaptiveGainIsVisps) {
  LawOptions options = test::unit_options(Law::Cur);
  options.gain = {4, 0.4, 30};
  Tutorial visp(test::input_at(test::kS0));
  visp.task().setLambda(4, 0.4, 30);
  const vpAdaptiveGain gain(4, 0.4, 30);
  for (const double x : {0., 1e-3, 0.1, 0.5, 3.}) EXPECT_NEAR(options.gain.at(x), gain(x), 1e-14);
  test::fly(test::kS0, options, 200, 1. / 30, [&](const test::Moment& m) {
    visp.see(m.input);
    const Vector6d v = Tutorial::twist(visp.task().computeControlLaw());
    ASSERT_LT(largest_difference(m.answer.twist->vector(), v), 1e-12);
  });
}

TEST(LawGain, IsTheFormula) {
  const LawGain gain{4, 0.4, 30};
  EXPECT_EQ(gain.at(0), 4);
  EXPECT_NEAR(gain.at(1e9), 0.4, 1e-15);
  EXPECT_NEAR((gain.at(1e-7) - gain.at(0)) / 1e-7, -30, 1e-3);
  EXPECT_EQ(LawGain::constant(0.7).at(3), 0.7);
  EXPECT_EQ(LawGain({2, 2, 5}).at(3), 2);
}

// computeControlLaw(t): the first twist is zero, and what is left of the start dies with mu.
TEST(LawAgainstVisp, SmoothStartIsVisps) {
  for (const LawGain& gain : {LawGain::constant(0.8), LawGain{2, 0.4, 3}}) {
    LawOptions options = test::unit_options(Law::Cur);
    options.gain = gain;
    options.smooth_start_per_s = 4;
    Tutorial visp(test::input_at(test::kS0));
    visp.task().setLambda(gain.at_zero_per_s, gain.at_infinity_per_s, gain.slope_at_zero_per_s);
    if (gain.slope_at_zero_per_s == 0) visp.task().setLambda(gain.at_zero_per_s);
    visp.task().setMu(4);
    int k = 0;
    test::fly(test::kS0, options, 100, 0.04, [&](const test::Moment& m) {
      visp.see(m.input);
      const Vector6d v = Tutorial::twist(visp.task().computeControlLaw(0.04 * k));
      ASSERT_LT(largest_difference(m.answer.twist->vector(), v), 1e-12) << k;
      if (k++ == 0) {
        EXPECT_LT(v.norm(), 1e-15);
      }
    });
    EXPECT_EQ(k, 100);
  }
}

}  // namespace
}  // namespace kestrel

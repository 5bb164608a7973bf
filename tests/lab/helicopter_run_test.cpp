#include "kestrel/lab/helicopter_run.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "kestrel/lab/helicopter_benchmark.hpp"

namespace kestrel {
namespace {

using Variant = HelicopterVariant;

HelicopterSetup setup_of(const HelicopterScenario& scenario, Variant variant, Law law,
                         const std::string& modifier = "") {
  return helicopter_experiment(scenario, variant, law, modifier).setup;
}

struct Flight {
  RunResult result;
  std::vector<HelicopterStep> steps;
};

Flight flown(const HelicopterSetup& setup) {
  Flight flight;
  flight.result =
      run_helicopter(setup, [&](const HelicopterStep& s) { flight.steps.push_back(s); });
  return flight;
}

double missed_m(const Flight& flight) { return flight.steps.back().position_error_m.norm(); }

TEST(HelicopterRun, LevelVariantsAndDrop6ReachTheGoalFromAWrongHeading) {
  for (const Variant variant : {Variant::Vp4, Variant::Drop6, Variant::Vp3Hh}) {
    const Flight flight = flown(setup_of(helicopter_h1(), variant, Law::Des));
    EXPECT_EQ(flight.result.end, RunEnd::Converged) << name(variant);
    EXPECT_EQ(flight.result.steps, 1201);  // 40 s, the world at the end included
    EXPECT_LT(missed_m(flight), 1e-3);
  }
}

// Z* tan(12 deg) = 1.063 m off the axis, on a circle about the target: 1.051 m, as published.
TEST(HelicopterRun, WithoutAHeadingItParksAside) {
  const Flight flight = flown(setup_of(helicopter_h1(), Variant::Vp3, Law::Des));
  EXPECT_NEAR(missed_m(flight), 1.051, 5e-4);
  EXPECT_EQ(flight.result.end, RunEnd::LocalMinimum);  // it stands, off in place and heading
  EXPECT_EQ(flown(setup_of(helicopter_h0(), Variant::Vp3, Law::Des)).result.end, RunEnd::Converged);
}

// vp3 parks aside with its heading 12 deg off. Standing is no local minimum before it has lasted,
// while noise moves the command, when nothing is seen (it hovers because it must), or from a
// threshold on below which nothing is still.
TEST(HelicopterRun, ALocalMinimumIsToStandInSightOfTheTarget) {
  const HelicopterSetup parked = setup_of(helicopter_h1(), Variant::Vp3, Law::Des);
  const auto end = [&](const auto& change) {
    HelicopterSetup setup = parked;
    change(setup);
    return flown(setup).result.end;
  };
  EXPECT_EQ(end([](auto&) {}), RunEnd::LocalMinimum);
  EXPECT_EQ(end([](auto& s) { s.conditions.duration_s = 12; }), RunEnd::TimedOut);
  EXPECT_EQ(end([](auto& s) { s.rules.still_s = 40; }), RunEnd::TimedOut);
  EXPECT_EQ(end([](auto& s) { s.conditions.noise_px = 1; }), RunEnd::TimedOut);
  EXPECT_EQ(end([](auto& s) { s.rules.still_threshold = 0; }), RunEnd::TimedOut);
  EXPECT_EQ(end([](auto& s) { s.conditions = modified(s.conditions, "loss2"); }), RunEnd::TimedOut);
}

// At 1e-4 m/s and rad/s the vehicle is still; moving through a point where the law asks for nothing
// it is not.
TEST(HelicopterRun, AVehicleThatMovesIsNotStill) {
  HelicopterSetup setup = setup_of(helicopter_h1(), Variant::Vp3, Law::Des);
  // At once: what counts is the last step alone, at which the slow loop still moves.
  setup.rules.still_s = 1e-9;
  std::optional<double> first_s;
  const Flight flight = flown(setup);
  for (const HelicopterStep& step : flight.steps) {
    const HelicopterState& s = step.frame.state;
    const double moving = std::hypot(s.velocity_m_s.norm(), s.yaw_rate_rad_s);
    const bool is_still = std::max(moving, step.wanted.vector().norm()) < 1e-4;
    if (is_still && !first_s) first_s = step.frame.time_s;
  }
  ASSERT_TRUE(first_s);
  setup.conditions.duration_s = *first_s - kHelicopterFrame_s;
  EXPECT_EQ(flown(setup).result.end, RunEnd::TimedOut);
  setup.conditions.duration_s = *first_s + 2 * kHelicopterFrame_s;
  EXPECT_EQ(flown(setup).result.end, RunEnd::LocalMinimum);
}

// A pitch that is wrong by b moves the level target by Z* tan b = .1746 m; measured .1762.
TEST(HelicopterRun, AnAttitudeBiasMovesTheGoalOfThoseWhoLevel) {
  const Flight levelled = flown(setup_of(helicopter_h0(), Variant::Vp4, Law::Des, "pitch2"));
  EXPECT_NEAR(missed_m(levelled), 0.1762, 5e-5);
  EXPECT_EQ(levelled.result.end, RunEnd::HeadingOnly);
  const Flight dropped = flown(setup_of(helicopter_h0(), Variant::Drop6, Law::Des, "pitch2"));
  EXPECT_LT(missed_m(dropped), 1e-4);
}

TEST(HelicopterRun, AMovingTargetIsFollowedAtSpeedOverGain) {
  HelicopterSetup setup = setup_of(helicopter_h0(), Variant::Vp3, Law::Des);
  setup.scenario.target_velocity_m_s = {0, 0.3, 0};
  EXPECT_NEAR(flown(setup).steps.back().position_error_m.y(), -0.600, 5e-4);  // -.3 / .5
  setup.conditions.feed_forward = true;
  EXPECT_LT(missed_m(flown(setup)), 5e-4);
}

/// Root mean squares near the goal, a pixel of noise: speed sent (m/s), position (m).
Eigen::Vector2d noisy_hover(Variant variant) {
  HelicopterSetup setup = setup_of(helicopter_h0(), variant, Law::Des, "n1_t240");
  setup.scenario.start_camera_m = {-5, 0, 0};
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  const RunResult result = run_helicopter(setup, [&](const HelicopterStep& step) {
    squares += Eigen::Vector2d(step.sent.vector().head<3>().squaredNorm(),
                               step.position_error_m.squaredNorm());
  });
  return (squares / result.steps).cwiseSqrt();
}

// 15 to 30 % more noise than vp4 is the published figure. Over 8 x 600 s it is 18 % of the speed
// that is sent (after the limits) and 38 % of the position: sideways both are as noisy, and drop6
// as much again downwards (helicopter_law_test has the closed form).
TEST(HelicopterRun, Drop6PaysForLevellingByItselfWithNoise) {
  const Eigen::Vector2d six = noisy_hover(Variant::Drop6);
  const Eigen::Vector2d four = noisy_hover(Variant::Vp4);
  EXPECT_GT(six[0] / four[0], 1.15);
  EXPECT_LT(six[0] / four[0], 1.30);
  // sqrt(2) less what limits cut; 240 s are some 100 independent samples: 10 %.
  EXPECT_NEAR(six[1] / four[1], 1.38, 0.14);
}

// Tilt moves the target in the image; the current matrix answers it ever more.
TEST(HelicopterRun, WithoutLevellingTheCurrentMatrixDoesNotSettle) {
  for (const char* modifier : {"l1", "kz2", "kz4"}) {
    const HelicopterSetup setup = setup_of(helicopter_h0(), Variant::Raw4, Law::Cur, modifier);
    EXPECT_NE(flown(setup).result.end, RunEnd::Converged) << modifier;
    const HelicopterSetup level = setup_of(helicopter_h0(), Variant::Vp4, Law::Cur, modifier);
    EXPECT_EQ(flown(level).result.end, RunEnd::Converged) << modifier;
  }
}

/// How far the camera gets within 4 s of a loss at 2 s.
double flown_blind_m(const std::string& reaction) {
  const Flight flight =
      flown(setup_of(helicopter_h0(), Variant::Vp3, Law::Des, "t6_loss2" + reaction));
  const auto place = [&](int k) {
    return flight.steps[std::size_t(k)].frame.world_from_camera.translation;
  };
  EXPECT_TRUE(flight.steps[59].seen);
  EXPECT_FALSE(flight.steps[60].seen);
  return (place(180) - place(60)).norm();
}

TEST(HelicopterRun, BlindItFliesOnOrStops) {
  EXPECT_NEAR(flown_blind_m("_hold"), 3.89, 5e-3);
  EXPECT_NEAR(flown_blind_m(""), 0.932, 2e-3);
  EXPECT_NEAR(flown_blind_m("_hover"), 0.704, 2e-3);
}

TEST(HelicopterRun, AfterALossItServoesAgain) {
  HelicopterSetup setup = setup_of(helicopter_h0(), Variant::Vp3, Law::Des);
  setup.conditions.loss = TargetLoss{2, 3};
  const Flight flight = flown(setup);
  EXPECT_EQ(flight.result.end, RunEnd::Converged);
  EXPECT_EQ(flight.steps[149].sent.vector(), Eigen::Vector4d::Zero());
  EXPECT_TRUE(flight.steps[150].seen);
  // Bumpless: the first command is within the acceleration of one frame.
  EXPECT_LE(flight.steps[150].sent.vector().cwiseAbs().maxCoeff(), 2.0 / 30 + 1e-12);
}

TEST(HelicopterRun, CommandsAreHeldForTheirPeriodAndWithinTheLimits) {
  const Flight flight = flown(setup_of(helicopter_h1(), Variant::Vp4, Law::Cur, "l2_p5_d3_n1_t10"));
  const VelocityCommand most = CommandLimits{}.speed;
  for (std::size_t k = 1; k + 1 < flight.steps.size(); ++k) {
    const Eigen::Vector4d sent = flight.steps[k].sent.vector();
    if (k % 5 != 0) {
      EXPECT_EQ(sent, flight.steps[k - 1].sent.vector());
    }
    EXPECT_TRUE((sent.cwiseAbs().array() <= most.vector().array() + 1e-12).all());
  }
}

TEST(HelicopterRun, PredictionTakesTheLatencyAway) {
  const auto end = [](const char* modifier) {
    return flown(setup_of(helicopter_h0(), Variant::Vp3, Law::Des, modifier)).result.end;
  };
  // 0.2 s of latency: the limit is 2.81/s without prediction and 5.46/s with it.
  EXPECT_NE(end("free_d6_l4"), RunEnd::Converged);
  EXPECT_EQ(end("free_d6_l4_pred"), RunEnd::Converged);
}

TEST(HelicopterRun, ARefusalIsTheReasonAndTheHelicopterHovers) {
  HelicopterSetup setup = setup_of(helicopter_h1(), Variant::Vp4, Law::Mean, "t5");
  setup.scenario.points_m.resize(2);
  const Flight flight = flown(setup);
  EXPECT_EQ(flight.result.end, RunEnd::Refused);
  EXPECT_EQ(flight.result.refusal, LawRefusal::FewPoints);
  for (const HelicopterStep& step : flight.steps) {
    EXPECT_EQ(step.sent.vector(), Eigen::Vector4d::Zero());
  }
}

TEST(HelicopterRun, EndsWithItsReasonWhereItCannotGoOn) {
  HelicopterSetup setup = setup_of(helicopter_h0(), Variant::Vp3, Law::Des, "t5");
  setup.scenario.start_camera_m.x() = 1;  // behind the wall
  EXPECT_EQ(flown(setup).result.end, RunEnd::Collision);
  EXPECT_EQ(flown(setup).result.steps, 1);
  setup.scenario.start_camera_m = {-80, 0, 0};
  EXPECT_EQ(flown(setup).result.end, RunEnd::Diverged);
  setup.scenario.start_camera_m = {-5, 6, 0};  // at 50 deg of a camera that sees 28
  setup.rules.stops_out_of_view = true;
  EXPECT_EQ(flown(setup).result.end, RunEnd::OutOfView);
}

TEST(HelicopterRun, PositionWithoutHeading) {
  HelicopterSetup setup = setup_of(helicopter_h0(), Variant::Vp3, Law::Des, "t1");
  setup.scenario.start_camera_m = {-5, 0, 0};
  setup.scenario.start_yaw_rad = 0.04;
  setup.scenario.target_velocity_m_s.setZero();
  setup.conditions.gain_per_s = 1e-6;
  EXPECT_EQ(flown(setup).result.end, RunEnd::PositionOnly);
}

TEST(HelicopterRun, IsTheSameToTheBit) {
  const HelicopterSetup setup = setup_of(helicopter_h1(), Variant::Vp4, Law::Mean, "n1_t5");
  const Flight a = flown(setup);
  const Flight b = flown(setup);
  ASSERT_EQ(a.steps.size(), b.steps.size());
  EXPECT_EQ(a.steps.back().frame.state.position_m, b.steps.back().frame.state.position_m);
  EXPECT_EQ(a.steps.back().sent.vector(), b.steps.back().sent.vector());
}

TEST(HelicopterRun, NonsenseIsNamedBeforeTheStart) {
  HelicopterSetup setup = setup_of(helicopter_h0(), Variant::Vp3, Law::Des);
  setup.rules.diverged_m = 0;
  EXPECT_THROW(flown(setup), std::invalid_argument);
  setup = setup_of(helicopter_h0(), Variant::Vp3, Law::Des);
  setup.conditions.period_frames = 0;
  EXPECT_THROW(flown(setup), std::invalid_argument);
  setup = setup_of(helicopter_h0(), Variant::Vp3, Law::Des);
  setup.law.heading_gain_per_s = NAN;
  EXPECT_THROW(flown(setup), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel

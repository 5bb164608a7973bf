#include "kestrel/eval/hover_metrics.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

constexpr double kPeriod = 1.0 / 30;

/// A flight whose position error falls as exp(-t) from start_m, target always in view.
std::vector<FlightSample> approach(double start_m, double duration_s) {
  std::vector<FlightSample> flight;
  for (int k = 0; k * kPeriod <= duration_s; ++k) {
    const double t = k * kPeriod;
    flight.push_back({t, start_m * std::exp(-t), 0.1 * std::exp(-t), 5.0, true});
  }
  return flight;
}

TEST(HoverMetrics, SettlesWhenTheLastToleranceIsReachedForGood) {
  // 4 m falls to 0.10 m at t = ln 40 = 3.689 s, 0.1 rad to 2 deg at t = 1.05 s: position decides.
  const HoverMetrics metrics = hover_metrics(approach(4, 8), {});
  ASSERT_TRUE(metrics.settled_s);
  EXPECT_GE(*metrics.settled_s, std::log(40.0));
  EXPECT_LE(*metrics.settled_s, std::log(40.0) + kPeriod);
  EXPECT_EQ(metrics.end, FlightEnd::Converged);
  EXPECT_NEAR(metrics.final_position_m, 4 * std::exp(-8), 4 * std::exp(-8) * kPeriod + 1e-12);
}

TEST(HoverMetrics, AHeadingErrorAloneKeepsItFromSettling) {
  auto flight = approach(4, 8);
  for (FlightSample& sample : flight) sample.heading_error_rad = -0.036;  // 2.06 deg
  EXPECT_FALSE(hover_metrics(flight, {}).settled_s);
  EXPECT_EQ(hover_metrics(flight, {}).end, FlightEnd::TimedOut);
}

TEST(HoverMetrics, LeavingTheToleranceStartsTheHoldAnew) {
  auto flight = approach(4, 5);  // within tolerance for 1.3 s only
  EXPECT_FALSE(ended(flight, {}));
  flight.push_back({5.1, 0.2, 0, 5, true});
  for (int k = 1; k <= 50; ++k) flight.push_back({5.1 + k * kPeriod, 0.05, 0, 5, true});
  EXPECT_FALSE(ended(flight, {}));  // 1.63 s since the return
  for (int k = 51; k <= 63; ++k) flight.push_back({5.1 + k * kPeriod, 0.05, 0, 5, true});
  EXPECT_EQ(ended(flight, {}), FlightEnd::Converged);
}

TEST(HoverMetrics, NamesWhatWentWrong) {
  auto flight = approach(4, 1);
  auto lost = flight;
  for (int k = 1; k <= 160; ++k) lost.push_back({1 + k * kPeriod, 3, 0, 5, false});
  EXPECT_EQ(ended(lost, {}), FlightEnd::TargetLost);
  EXPECT_NEAR(hover_metrics(lost, {}).longest_unseen_s, 160 * kPeriod, 2 * kPeriod);
  EXPECT_NEAR(hover_metrics(lost, {}).seen_share, 31.0 / 191, 2.0 / 191);
  auto hit = flight;
  hit.push_back({2, 4.8, 0, 0.2, true});
  EXPECT_EQ(ended(hit, {}), FlightEnd::Collision);
  auto away = flight;
  away.push_back({2, 51, 0, 5, true});
  EXPECT_EQ(ended(away, {}), FlightEnd::Diverged);
  auto nonsense = flight;
  nonsense.push_back({2, std::numeric_limits<double>::quiet_NaN(), 0, 5, true});
  EXPECT_EQ(ended(nonsense, {}), FlightEnd::Diverged);
}

TEST(HoverMetrics, AnEmptyFlightHasNoEnd) {
  EXPECT_FALSE(ended({}, {}));
  EXPECT_EQ(hover_metrics({}, {}).end, FlightEnd::TimedOut);
  EXPECT_STREQ(name(FlightEnd::TargetLost), "target lost");
}

TEST(HoverMetrics, RefusesToleranceThatIsNoNumber) {
  HoverGoal goal;
  goal.hold_s = 0;
  EXPECT_THROW(goal.check(), std::invalid_argument);
  goal.hold_s = std::numeric_limits<double>::infinity();
  EXPECT_THROW(goal.check(), std::invalid_argument);
  EXPECT_NO_THROW(HoverGoal{}.check());
}

}  // namespace
}  // namespace kestrel

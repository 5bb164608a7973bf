#include "kestrel/lab/helicopter_experiment.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "kestrel/lab/helicopter_benchmark.hpp"

namespace kestrel {
namespace {

using Variant = HelicopterVariant;

std::optional<double> metric(const LabRun& run, const std::string& name) {
  const auto found = std::find_if(run.metrics.begin(), run.metrics.end(),
                                  [&](const auto& m) { return m.first == name; });
  EXPECT_NE(found, run.metrics.end()) << name;
  return found == run.metrics.end() ? std::nullopt : found->second;
}

TEST(HelicopterExperiment, IsFiledUnderScenarioLawAndModifier) {
  HelicopterExperiment e = helicopter_experiment(helicopter_h1(), Variant::Vp3Hh, Law::Mean, "t1");
  EXPECT_EQ(e.id(), "H1/vp3_hh_mean/t1");
  const LabRun made = run(e);
  EXPECT_EQ(made.id, "H1/vp3_hh_mean/t1");
  EXPECT_EQ(made.scenario, "H1");
  EXPECT_EQ(made.law, "vp3_hh_mean");
  EXPECT_EQ(made.modifier, "t1");
  EXPECT_EQ(made.kind, RunKind::Helicopter);
  EXPECT_EQ(made.steps, 31);
  e.modifier.clear();
  EXPECT_EQ(e.id(), "H1/vp3_hh_mean");
  EXPECT_EQ(helicopter_law_label(Variant::Mejias, Law::Cur), "mejias");
}

TEST(HelicopterExperiment, TheTraceHoldsFirstEveryNthAndLast) {
  HelicopterExperiment e = helicopter_experiment(helicopter_h0(), Variant::Vp3, Law::Des, "t1");
  e.trace_every = 7;
  EXPECT_EQ(run(e).trace.column("step"), (std::vector<double>{0, 7, 14, 21, 28, 30}));
  e.trace_every = 10;
  EXPECT_EQ(run(e).trace.column("step"), (std::vector<double>{0, 10, 20, 30}));
  e.trace_every = 0;
  EXPECT_TRUE(run(e).trace.rows.empty());
}

TEST(HelicopterExperiment, TimeIsOfTheClockGiven) {
  const HelicopterExperiment e =
      helicopter_experiment(helicopter_h0(), Variant::Vp3, Law::Des, "t1");
  EXPECT_EQ(run(e).law_us, 0);
  double now_s = 0;
  const LabRun made = run(e, [&] { return now_s += 1e-6; });
  EXPECT_NEAR(made.law_us, 30.0 / 31, 1e-9);  // 30 commands in 31 frames
}

// Gain 2/s, with limits: without levelling it works with L*, but detours.
TEST(HelicopterExperiment, WithoutLevellingTheWayIsLongerAndTheTimeToo) {
  HelicopterExperiment raw = helicopter_experiment(helicopter_h0(), Variant::Raw4, Law::Des, "l2");
  HelicopterExperiment level = helicopter_experiment(helicopter_h0(), Variant::Vp4, Law::Des, "l2");
  raw.trace_every = level.trace_every = 0;
  const LabRun detour = run(raw);
  EXPECT_NEAR(metric(detour, "settle_s").value(), 16, 0.5);
  EXPECT_NEAR(metric(detour, "path_ratio").value(), 3.4, 0.05);
  const LabRun straight = run(level);
  EXPECT_NEAR(metric(straight, "settle_s").value(), 6, 0.5);
  EXPECT_NEAR(metric(straight, "path_ratio").value(), 1.6, 0.05);
}

}  // namespace
}  // namespace kestrel

#include "kestrel/lab/camera_run.hpp"

#include <gtest/gtest.h>

#include "kestrel/lab/benchmark.hpp"

namespace kestrel {
namespace {

CameraSetup setup_of(std::size_t scenario, Law law, int steps) {
  CameraSetup setup;
  setup.scenario = benchmark_scenarios()[scenario];
  setup.law = benchmark_law(law);
  setup.conditions.steps = steps;
  return setup;
}

std::vector<RunStep> steps_of(const CameraSetup& setup) {
  std::vector<RunStep> steps;
  run_camera(setup, [&](const RunStep& step) { steps.push_back(step); });
  return steps;
}

TEST(CameraRun, MeetsTheTutorialsErrors) {
  // ViSP's tutorial-ibvs-4pts: gain 0.5, 40 ms, |e| after 150 steps; ten printed digits.
  const std::pair<Law, double> published[] = {
      {Law::Cur, 2.253876834e-02}, {Law::Des, 3.406660226e-02}, {Law::Mean, 2.868349185e-02}};
  for (const auto& [law, error] : published) {
    CameraSetup setup = setup_of(0, law, 151);
    setup.conditions.gain_per_s = 0.5;
    setup.conditions.rate_hz = 25;
    const std::vector<RunStep> steps = steps_of(setup);
    ASSERT_EQ(steps.size(), 151u);
    EXPECT_NEAR(steps.front().error.norm(), .469108342, 1e-9);
    EXPECT_NEAR(steps.back().error.norm(), error, 1e-10) << name(law);
  }
}

}  // namespace
}  // namespace kestrel

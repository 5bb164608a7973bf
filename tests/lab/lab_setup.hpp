#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "kestrel/lab/benchmark.hpp"

namespace kestrel::test {

/// A law on one of the benchmark's scenarios, ideal conditions.
inline CameraSetup benchmark_setup(const std::string& scenario, Law law, int steps) {
  for (const Scenario& candidate : benchmark_scenarios()) {
    if (candidate.name != scenario) continue;
    CameraSetup setup;
    setup.scenario = candidate;
    setup.law = benchmark_law(law);
    setup.conditions.steps = steps;
    return setup;
  }
  throw std::invalid_argument("no scenario " + scenario);
}

/// All steps of a run.
inline std::vector<RunStep> steps_of(const CameraSetup& setup) {
  std::vector<RunStep> steps;
  run_camera(setup, [&](const RunStep& step) { steps.push_back(step); });
  return steps;
}

}  // namespace kestrel::test

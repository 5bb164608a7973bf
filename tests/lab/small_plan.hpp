#pragma once

#include "kestrel/lab/benchmark.hpp"
#include "kestrel/lab/lab_plan.hpp"

namespace kestrel::test {

/// A plan with a little of everything.
inline LabPlan small_plan() {
  LabPlan plan;
  plan.title = "small";
  plan.laws = {{"cur", benchmark_law(Law::Cur)}, {"des", benchmark_law(Law::Des)}};
  plan.scenarios = {benchmark_scenarios()[0], benchmark_scenarios()[3]};
  plan.trace_every = 10;
  plan.modifiers = {{"kz2", "", {{"depth_factor", 2}}, {"S0_tutorial"}, {"cur"}}};
  plan.maps = {{"m", "S0_tutorial", {"des"}, {"depth_factor", {1, 2}}, {"delay_frames", {0, 1}}}};
  plan.basins = {{"b", "S0_tutorial", {}, {StartPose{{0, 0, -0.1}, {0, 0, 0}}, StartPose{}}}};
  plan.margins = {{"S0_tutorial", {"cur"}, true, true}};
  plan.orders = {{"S0_tutorial", {"des"}}};
  plan.helicopter.scenarios = {helicopter_h0()};
  plan.helicopter.laws = {benchmark_helicopter_law("vp3_hh_des")};
  plan.helicopter.modifiers = {{"kz2", "kz2", {}, {}, {}}};
  return plan;
}

}  // namespace kestrel::test

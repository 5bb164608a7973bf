// What it costs to fly without a camera; `times_real` is simulated seconds for each second of CPU.
//
//     taskset -c 0 build/dev/vehicle_bench
#include <benchmark/benchmark.h>

#include "kestrel/sim/vehicle.hpp"

namespace kestrel {
namespace {

/// Commanded anew at the rate of a camera, in turns.
void fly(benchmark::State& state, const VehicleOptions& options) {
  constexpr double kFrame_s = 1.0 / 30;
  Vehicle vehicle(options, {}, 1);
  long frame = 0;
  for (auto _ : state) {
    const double forward_m_s = frame++ % 120 < 60 ? 0.5 : -0.5;
    vehicle.advance({forward_m_s, 0.2, -forward_m_s / 5, 0.1}, kFrame_s);
    benchmark::DoNotOptimize(vehicle.motion());
  }
  state.counters["times_real"] =
      benchmark::Counter(kFrame_s, benchmark::Counter::kIsIterationInvariantRate);
}

void plant_of_loops(benchmark::State& state) { fly(state, HelicopterOptions{}); }
BENCHMARK(plant_of_loops);

void rigid_helicopter(benchmark::State& state) { fly(state, RotorcraftSystem{}); }
BENCHMARK(rigid_helicopter);

}  // namespace
}  // namespace kestrel

BENCHMARK_MAIN();

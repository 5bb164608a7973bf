// Times of a tracked frame and of its stages, and of detections, beside other trackers on the same
// frames: read the ratios. `--benchmark_filter=aligned|detected|tracked` chooses.
#include <string>

#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>

#include "bench/align_stages.hpp"
#include "bench/bench_frames.hpp"
#include "bench/detect_stages.hpp"
#include "bench/methods.hpp"

namespace kestrel::test {
namespace {

FrameWork begun(const BenchMethod& method, const BenchFrames& all) {
  BenchTracker track = method.learn(all.frames[0].gray, all.template_px);
  return [&all, track](std::size_t k) { benchmark::DoNotOptimize(track(all.frames[k])); };
}

/// A tracker on the whole sequence, its start included, beside the hybrid.
void tracked(benchmark::State& state, const std::string& name) {
  const BenchFrames& all = whole_frames();
  const BenchMethod theirs = bench_methods({name}).front();
  const BenchMethod ours = bench_methods({"hybrid"}).front();
  time_beside(
      state, all.frames.size(), [&] { return begun(theirs, all); },
      [&] { return begun(ours, all); });
}

/// Every tracker there is, "tracked/...".
void register_tracked() {
  for (const BenchMethod& method : bench_methods()) {
    benchmark::RegisterBenchmark(("tracked/" + method.name).c_str(),
                                 [name = method.name](benchmark::State& s) { tracked(s, name); })
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond)
        ->Iterations(method.name == "hybrid" ? 10 : 1);
  }
}

}  // namespace
}  // namespace kestrel::test

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  kestrel::test::register_align_stages();
  kestrel::test::register_detect_stages();
  kestrel::test::register_tracked();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

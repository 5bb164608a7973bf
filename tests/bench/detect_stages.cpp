#include "bench/detect_stages.hpp"

#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "kestrel/vision/detector.hpp"
#include "kestrel/vision/feature_match.hpp"
#include "kestrel/vision/sift.hpp"
#include "kestrel/vision/target_search.hpp"
#include "kestrel/vision/template.hpp"
#include "kestrel/vision/vote_homography.hpp"

#include "bench/bench_frames.hpp"
#include "bench/methods.hpp"

namespace kestrel::test {
namespace {

using Load = const BenchFrames& (*)();

PixelBox whole(const Frame& frame) {
  return {0, 0, double(frame.gray.cols), double(frame.gray.rows)};
}

void nothing(std::size_t) {}

void sift(benchmark::State& state, Load load) {
  const BenchFrames& all = load();
  FastSift detector({});
  double keypoints = 0;
  double calls = 0;
  time_frames(state, all.frames.size(), nothing, [&](std::size_t k) {
    keypoints += double(detector.detect(all.frames[k].gray, whole(all.frames[k])).at.size());
    ++calls;
  });
  state.counters["keypoints"] = keypoints / calls;
}

void match(benchmark::State& state, Load load) {
  const BenchFrames& all = load();
  const Template model(all.frames[0].gray, all.template_px, {});
  FastSift detector({});
  FeatureMatcher matcher(model.features(), {});
  const SiftPoints* seen = nullptr;
  double image_keypoints = 0;
  double pairs = 0;
  double calls = 0;
  time_frames(
      state, all.frames.size(),
      [&](std::size_t k) {
        seen = &detector.detect(all.frames[k].gray, whole(all.frames[k]));
        image_keypoints += double(seen->at.size());
      },
      [&](std::size_t) {
        pairs += double(matcher.match(*seen).size());
        ++calls;
      });
  state.counters["template_features"] = double(model.features().at.size());
  state.counters["keypoints"] = image_keypoints / calls;
  state.counters["pairs"] = pairs / calls;
}

void fit(benchmark::State& state, Load load) {
  const BenchFrames& all = load();
  const Template model(all.frames[0].gray, all.template_px, {});
  FastSift detector({});
  FeatureMatcher matcher(model.features(), {});
  std::vector<AffinePair> pairs;
  double hypotheses = 0;
  double calls = 0;
  time_frames(
      state, all.frames.size(),
      [&](std::size_t k) {
        pairs = matcher.match(detector.detect(all.frames[k].gray, whole(all.frames[k])));
      },
      [&](std::size_t) {
        hypotheses += double(vote_homographies(pairs, model.width(), model.height(), {}).size());
        ++calls;
      });
  state.counters["hypotheses"] = hypotheses / calls;
}

/// SIFT, match, fit, alignment of every hypothesis, verdict.
void chain(benchmark::State& state, Load load) {
  const BenchFrames& all = load();
  const TrackOptions options;
  const Template model(all.frames[0].gray, all.template_px, options);
  TargetSearch search(model, options);
  double found = 0;
  double calls = 0;
  time_frames(state, all.frames.size(), nothing, [&](std::size_t k) {
    const Frame& frame = all.frames[k];
    found += search.detect(frame, whole(frame), std::nullopt).is_accepted() ? 1 : 0;
    ++calls;
  });
  state.counters["found_%"] = 100 * found / calls;
}

/// A tracker that looks at the whole image in every frame, beside the chain.
void peer(benchmark::State& state, Load load) {
  const BenchFrames& all = load();
  const TrackOptions options;
  const Template model(all.frames[0].gray, all.template_px, options);
  TargetSearch search(model, options);
  const BenchMethod method = bench_methods({"cv_sift_flann_full"}).front();
  const BenchTracker track = method.learn(all.frames[0].gray, all.template_px);
  double found = 0;
  double calls = 0;
  FrameWork theirs = [&](std::size_t k) {
    found += track(all.frames[k]).image_from_template ? 1 : 0;
    ++calls;
  };
  FrameWork ours = [&](std::size_t k) {
    const Frame& frame = all.frames[k];
    benchmark::DoNotOptimize(search.detect(frame, whole(frame), std::nullopt).is_accepted());
  };
  time_beside(
      state, all.frames.size(), [&] { return theirs; }, [&] { return ours; });
  state.counters["found_%"] = 100 * found / calls;
}

void add(const std::string& name, void (*bench)(benchmark::State&, Load), Load load) {
  auto* added = benchmark::RegisterBenchmark(
      name.c_str(), [bench, load](benchmark::State& state) { bench(state, load); });
  added->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(bench == peer ? 1 : kCalls);
}

}  // namespace

void register_detect_stages() {
  const std::vector<std::pair<std::string, Load>> images = {{"256x256", cropped_frames},
                                                            {"640x480", whole_frames}};
  for (const auto& [size, load] : images) {
    const std::string start = "detected/" + size + "/";
    add(start + "sift", sift, load);
    add(start + "match", match, load);
    add(start + "fit", fit, load);
    add(start + "chain", chain, load);
    add(start + "cv_sift_flann_full", peer, load);
  }
}

}  // namespace kestrel::test

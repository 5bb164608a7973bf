#include "bench/align_stages.hpp"

#include <algorithm>
#include <vector>

#include <benchmark/benchmark.h>

#include <opencv2/imgproc.hpp>

#include "kestrel/vision/agreement.hpp"
#include "kestrel/vision/align.hpp"
#include "kestrel/vision/image_pyramid.hpp"
#include "kestrel/vision/template.hpp"

#include "../../src/vision/align/block_kernels.hpp"
#include "bench/bench_frames.hpp"

namespace kestrel::test {
namespace {

constexpr int kPyramidLevels = 4;  // as many as the template has

void nothing(std::size_t) {}

/// The target's outline in frame k with the margin the tracker leaves, at least 16 px.
PixelBox window_of(const BenchFrames& all, std::size_t k) {
  const auto corners = outline(all.truth[k], all.template_px.width, all.template_px.height);
  const auto [left, right] = std::minmax({corners[0].u, corners[1].u, corners[2].u, corners[3].u});
  const auto [top, bottom] = std::minmax({corners[0].v, corners[1].v, corners[2].v, corners[3].v});
  const double by = 16 + 0.15 * std::max(right - left, bottom - top);
  return {left - by, top - by, right - left + 2 * by, bottom - top + 2 * by};
}

enum class Part { Window, Frame };

PixelBox part_of(const BenchFrames& all, std::size_t k, Part part) {
  if (part == Part::Window) return window_of(all, k);
  return {0, 0, double(all.frames[k].gray.cols), double(all.frames[k].gray.rows)};
}

void pyramid(benchmark::State& state, Part part) {
  const BenchFrames& all = whole_frames();
  ImagePyramid made;
  time_frames(state, all.frames.size(), nothing, [&](std::size_t k) {
    made.look(all.frames[k].gray, part_of(all, k, part), kPyramidLevels, Simd::Auto);
  });
  const double read_bytes = clipped(part_of(all, 0, part), 640, 480).width *
                            clipped(part_of(all, 0, part), 640, 480).height * 4 / 3;
  state.counters["read_GB_s"] = read_bytes / (1e3 * state.counters["median_us"]);
}

/// The same means of four pixels by OpenCV.
void pyramid_opencv(benchmark::State& state) {
  const BenchFrames& all = whole_frames();
  ImagePyramid ours;
  std::vector<cv::Mat> theirs(kPyramidLevels - 1);
  time_beside(
      state, all.frames.size(),
      [&]() -> FrameWork {
        return [&](std::size_t k) {
          cv::Mat above = all.frames[k].gray;
          for (cv::Mat& level : theirs) {
            cv::resize(above, level, {above.cols / 2, above.rows / 2}, 0, 0, cv::INTER_AREA);
            above = level;
          }
        };
      },
      [&]() -> FrameWork {
        return [&](std::size_t k) {
          ours.look(all.frames[k].gray, part_of(all, k, Part::Frame), kPyramidLevels, Simd::Auto);
        };
      });
}

/// A learned template, an aligner, and the pyramid of the frame whose turn it is.
struct Bed {
  const BenchFrames& all = whole_frames();
  Template model{all.frames[0].gray, all.template_px, {}};
  Aligner aligner{model.blocks(), {}};
  ImagePyramid pyramid;

  void look(std::size_t k) {
    pyramid.look(all.frames[k].gray, window_of(all, k), aligner.levels(), Simd::Auto);
  }
  /// Where the template was a frame before.
  const Homography& before(std::size_t k) const { return all.truth[k > 0 ? k - 1 : 0]; }
};

void aligned(benchmark::State& state) {
  Bed bed;
  double iterations = 0;
  double calls = 0;
  time_frames(
      state, bed.all.frames.size(), [&](std::size_t k) { bed.look(k); },
      [&](std::size_t k) {
        const auto found = bed.aligner.align(bed.pyramid, bed.before(k));
        iterations += found ? found->iterations : 0;
        ++calls;
      });
  state.counters["iterations"] = iterations / calls;
  state.counters["blocks"] = double(bed.model.blocks().levels[0].blocks.size());
}

void likeness(benchmark::State& state) {
  Bed bed;
  time_frames(
      state, bed.all.frames.size(), [&](std::size_t k) { bed.look(k); },
      [&](std::size_t k) {
        benchmark::DoNotOptimize(bed.aligner.likeness(bed.pyramid, bed.before(k)));
      },
      32);
  const auto& levels = bed.model.blocks().levels;
  state.counters["levels"] = double(levels.size());
  state.counters["coarsest_blocks"] = double(levels.back().blocks.size());
}

void searched(benchmark::State& state) {
  Bed bed;
  time_frames(
      state, bed.all.frames.size(), [&](std::size_t k) { bed.look(k); },
      [&](std::size_t k) {
        benchmark::DoNotOptimize(bed.aligner.search(bed.pyramid, bed.before(k)));
      });
}

/// One look at all blocks of the finest level, its pixels in the first-level cache or near it.
void sampled(benchmark::State& state, kernel::SampleBlocks sample) {
  const Bed bed;
  const BlockLevel& level = bed.model.blocks().levels[0];
  std::vector<kernel::Block> blocks;
  for (std::size_t i = 0; i < level.blocks.size(); ++i) {
    blocks.push_back(
        {float(level.blocks[i].u), float(level.blocks[i].v),
         level.textures.data() + i * kernel::kBlockPixels,
         level.derivatives.data() + i * std::size_t(kernel::kBlockPixels) * kernel::kParameters});
  }
  std::vector<kernel::BlockSums> sums(blocks.size());
  const cv::Mat& gray = bed.all.frames[1].gray;
  const kernel::Image image{gray.data, std::ptrdiff_t(gray.step[0]), 0,
                            0,         float(gray.cols - 2),         float(gray.rows - 2)};
  const Eigen::Matrix<float, 3, 3, Eigen::RowMajor> H = bed.all.truth[1].H.cast<float>();
  time_frames(
      state, 1, nothing,
      [&](std::size_t) {
        sample(image, H.data(), blocks.data(), int(blocks.size()), sums.data());
        benchmark::ClobberMemory();
      },
      32);
  state.counters["ns_px"] =
      1e3 * state.counters["median_us"] / double(blocks.size() * std::size_t(kernel::kBlockPixels));
}

/// The verdict on 96 blocks, with the copy that the count reorders.
void agreed(benchmark::State& state) {
  std::vector<BlockLikeness> likely(96);
  for (std::size_t i = 0; i < likely.size(); ++i) likely[i] = {true, double((i * 37) % 96) / 96};
  std::vector<BlockLikeness> copy;
  time_frames(
      state, 1, nothing,
      [&](std::size_t) {
        copy = likely;
        benchmark::DoNotOptimize(agreement(copy, {}));
      },
      32);
}

void stage(const char* name, void (*bench)(benchmark::State&)) {
  benchmark::RegisterBenchmark(name, bench)
      ->UseManualTime()
      ->Unit(benchmark::kMicrosecond)
      ->Iterations(kCalls);
}

}  // namespace

void register_align_stages() {
  stage("aligned/pyramid_window", [](benchmark::State& s) { pyramid(s, Part::Window); });
  stage("aligned/pyramid_frame", [](benchmark::State& s) { pyramid(s, Part::Frame); });
  stage("aligned/pyramid_frame_opencv", pyramid_opencv);
  if (use_avx2(Simd::Auto)) {
    stage("aligned/sample_blocks",
          [](benchmark::State& s) { sampled(s, kernel::sample_blocks_avx2); });
    stage("aligned/score_blocks",
          [](benchmark::State& s) { sampled(s, kernel::score_blocks_avx2); });
  }
  stage("aligned/sample_blocks_baseline",
        [](benchmark::State& s) { sampled(s, kernel::sample_blocks_baseline); });
  stage("aligned/align", aligned);
  stage("aligned/likeness", likeness);
  stage("aligned/search", searched);
  stage("aligned/agreement", agreed);
}

}  // namespace kestrel::test

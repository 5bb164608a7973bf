// Times of SIFT and matching, beside OpenCV's in the same run: read the ratios.
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "kestrel/vision/feature_match.hpp"
#include "kestrel/vision/sift.hpp"

#include "../../src/vision/sift/describe.hpp"
#include "../../src/vision/sift/octave.hpp"
#include "support/random.hpp"
#include "support/rendered_view.hpp"

namespace kestrel {
namespace {

/// The middle of a picture of 640x480 px, or a smaller part of it.
cv::Mat picture(benchmark::State& state) {
  static const cv::Mat kWhole = [] {
    cv::setNumThreads(1);
    test::Random random("bench");
    cv::Mat gray = test::texture(640, 480, random);
    test::add_noise(gray, 2, random);
    return gray;
  }();
  const int width = int(state.range(0));
  const int height = int(state.range(1));
  return kWhole(cv::Rect((640 - width) / 2, (480 - height) / 2, width, height));
}

PixelBox whole(const cv::Mat& image) { return {0, 0, double(image.cols), double(image.rows)}; }

sift::Ladder ladder(double contrast) {
  sift::Ladder result;
  result.wanted = {contrast, 10};
  result.kernels = &kernels::table(Simd::Auto);
  result.blurs.push_back(sift::gaussian_taps(0.5, 1.6));
  for (int i = 1; i < 6; ++i)
    result.blurs.push_back(
        sift::gaussian_taps(1.6 * std::pow(2, (i - 1) / 3.), 1.6 * std::pow(2, i / 3.)));
  return result;
}

/// All octaves; with a contrast nothing has, the search finds nothing to refine.
void scale_space(benchmark::State& state, double contrast) {
  const cv::Mat gray = picture(state);
  const sift::Ladder steps = ladder(contrast);
  std::vector<sift::Octave> octaves(5);
  for (auto _ : state) {
    octaves[0].build({gray, false}, steps);
    for (std::size_t o = 1; o < octaves.size(); ++o) octaves[o].build(octaves[o - 1], steps);
  }
}
void pyramid_and_search(benchmark::State& state) { scale_space(state, 250); }
void pyramid_search_refinement(benchmark::State& state) { scale_space(state, 3.4); }

void describe(benchmark::State& state) {
  const cv::Mat gray = picture(state);
  sift::Octave octave;
  octave.build({gray, false}, ladder(3.4));
  const auto grid = sift::descriptor_grid();
  const kernels::Table& table = kernels::table(Simd::Auto);
  for (auto _ : state) {
    for (const sift::Extremum& e : octave.extrema()) {
      const sift::Spot spot{e.at.layer, float(e.at.u), float(e.at.v), 2};
      const sift::Peaks peaks = sift::orientations(octave, spot, table);
      benchmark::DoNotOptimize(sift::described(octave, spot, peaks.angle[0], grid, table));
    }
  }
  state.counters["keypoints"] = double(octave.extrema().size());
}

void detect(benchmark::State& state, Simd simd) {
  const cv::Mat gray = picture(state);
  FastSiftOptions options;
  options.simd = simd;
  FastSift detector(options);
  for (auto _ : state) benchmark::DoNotOptimize(detector.detect(gray, whole(gray)));
  state.counters["keypoints"] = double(detector.detect(gray, whole(gray)).at.size());
}
void detect_auto(benchmark::State& state) { detect(state, Simd::Auto); }
void detect_baseline(benchmark::State& state) { detect(state, Simd::Baseline); }

void detect_opencv(benchmark::State& state) {
  const cv::Mat gray = picture(state);
  const auto sift = cv::SIFT::create(1000);
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  for (auto _ : state) sift->detectAndCompute(gray, cv::noArray(), keypoints, descriptors);
  state.counters["keypoints"] = double(keypoints.size());
}

/// 500 keypoints of the image against 300 of the template, from pictures that have as many.
struct Descriptors {
  LearnedFeatures model;
  SiftPoints image;
};

Descriptors descriptors() {
  test::Random random("bench");
  const cv::Mat gray = test::texture(640, 480, random);
  Descriptors result;
  result.image = FastSift({}).detect(gray, whole(gray));
  result.image.at.resize(500, result.image.at.front());
  result.image.descriptors.resize(500, result.image.descriptors.front());
  for (std::size_t i = 0; i < 300; ++i) {
    const SiftPoint& p = result.image.at[i];
    result.model.at.push_back(
        {{double(p.u), double(p.v)}, Eigen::Matrix2f::Identity(), p.scale_px, 0});
    result.model.descriptors.push_back(result.image.descriptors[i]);
  }
  return result;
}

void match(benchmark::State& state, Simd simd) {
  const Descriptors d = descriptors();
  FeatureMatchOptions options;
  options.simd = simd;
  FeatureMatcher matcher(d.model, options);
  for (auto _ : state) benchmark::DoNotOptimize(matcher.match(d.image));
}
void match_auto(benchmark::State& state) { match(state, Simd::Auto); }
void match_baseline(benchmark::State& state) { match(state, Simd::Baseline); }

cv::Mat rows(const std::vector<Descriptor>& all) {
  cv::Mat result(int(all.size()), 128, CV_32F);
  for (int i = 0; i < result.rows; ++i)
    for (int b = 0; b < 128; ++b)
      result.at<float>(i, b) = float(all[std::size_t(i)].bin[std::size_t(b)]);
  return result;
}

void match_opencv(benchmark::State& state) {
  const Descriptors d = descriptors();
  const cv::Mat model = rows(d.model.descriptors);
  const cv::Mat image = rows(d.image.descriptors);
  const cv::BFMatcher matcher(cv::NORM_L2);
  std::vector<std::vector<cv::DMatch>> matches;
  for (auto _ : state) matcher.knnMatch(image, model, matches, 2);
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->Args({256, 256})->Args({640, 480})->Unit(benchmark::kMicrosecond);
}
BENCHMARK(pyramid_and_search)->Apply(sizes);
BENCHMARK(pyramid_search_refinement)->Apply(sizes);
BENCHMARK(describe)->Apply(sizes);
BENCHMARK(detect_auto)->Apply(sizes);
BENCHMARK(detect_baseline)->Apply(sizes);
BENCHMARK(detect_opencv)->Apply(sizes);
BENCHMARK(match_auto)->Unit(benchmark::kMicrosecond);
BENCHMARK(match_baseline)->Unit(benchmark::kMicrosecond);
BENCHMARK(match_opencv)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace kestrel

BENCHMARK_MAIN();

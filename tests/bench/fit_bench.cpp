// Robust fits side by side: time, and the share of answers within 5 px at the corners. Pairs are
// planted with the noise of keypoints; their ratios say nothing, so that no method gains by order.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <opencv2/calib3d.hpp>

#include "kestrel/vision/robust_homography.hpp"
#include "kestrel/vision/vote_homography.hpp"

#include "support/planted_pairs.hpp"

namespace kestrel {
namespace {

constexpr double kWidth = 160;
constexpr double kHeight = 120;
constexpr int kSets = 400;
constexpr double kCorrectPx = 5;

struct Scene {
  int pairs = 60;
  double inlier_share = 0.3;
  test::LinearMap map = test::LinearMap::Affine;
  PixelBox image;
  std::string name;
};

struct PlantedSet {
  Homography truth;
  std::vector<AffinePair> pairs;
  std::vector<PixelPair> places;
};

std::vector<PlantedSet> sets_of(const Scene& scene) {
  test::Random random(scene.name);
  test::PlantedOptions o;
  o.inliers = int(std::lround(scene.inlier_share * scene.pairs));
  o.outliers = scene.pairs - o.inliers;
  o.map = scene.map;
  o.image = scene.image;
  std::vector<PlantedSet> sets(kSets);
  for (PlantedSet& set : sets) {
    const bool tilted = scene.map == test::LinearMap::Similarity;
    const double tilt = tilted ? random.uniform(M_PI / 4, M_PI / 3) : random.uniform(0, M_PI / 3);
    set.truth = test::planted_view(tilt, o, random);
    set.pairs = test::shuffled(test::planted(set.truth, o, random), random);
    for (const AffinePair& pair : set.pairs)
      set.places.push_back({pair.in_template, pair.in_image});
  }
  return sets;
}

using Answer = std::optional<Homography>;
using Method = std::function<Answer(const PlantedSet&)>;

Answer by_votes(const PlantedSet& set) {
  const auto found = vote_homographies(set.pairs, kWidth, kHeight, {});
  if (found.empty()) return std::nullopt;
  return found.front().image_from_template;
}

Answer by_ransac(const PlantedSet& set) {
  RansacOptions options;
  options.min_inliers = 6;
  options.min_inlier_share = 0;
  const auto found = ransac_homography(set.places, options);
  if (!found) return std::nullopt;
  return found->image_from_template;
}

/// The least-squares fit of the true inliers within tolerance: no method can know more.
Answer by_truth(const PlantedSet& set) {
  std::vector<PixelPair> inliers;
  for (const PixelPair& pair : set.places) {
    if (distance(set.truth * pair.in_template, pair.in_image) < 5) inliers.push_back(pair);
  }
  return fit_homography(inliers);
}

Answer by_opencv(const PlantedSet& set, int method) {
  std::vector<cv::Point2d> from;
  std::vector<cv::Point2d> to;
  for (const PixelPair& pair : set.places) {
    from.emplace_back(pair.in_template.u, pair.in_template.v);
    to.emplace_back(pair.in_image.u, pair.in_image.v);
  }
  const cv::Mat found = cv::findHomography(from, to, method, 3, cv::noArray(), 2000, 0.995);
  if (found.empty()) return std::nullopt;
  Homography H;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) H.H(r, c) = found.at<double>(r, c);
  }
  return H;
}

bool is_correct(const Answer& answer, const Homography& truth) {
  return answer && test::corner_distance(*answer, truth, kWidth, kHeight) < kCorrectPx;
}

/// Processor time of this thread: the longest fit is not when somebody else had the processor.
double thread_cpu_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * double(now.tv_sec) + 1e-3 * double(now.tv_nsec);
}

void measure(benchmark::State& state, const Scene& scene, const Method& method) {
  const std::vector<PlantedSet> sets = sets_of(scene);
  std::vector<double> each_us;
  int correct = 0;
  for (const PlantedSet& set : sets) {
    const double start_us = thread_cpu_us();
    const Answer answer = method(set);
    each_us.push_back(thread_cpu_us() - start_us);
    correct += is_correct(answer, set.truth) ? 1 : 0;
  }
  std::sort(each_us.begin(), each_us.end());
  std::size_t next = 0;
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(method(sets[next]));
    next = (next + 1) % sets.size();
  }
  state.counters["correct_%"] = 100.0 * correct / kSets;
  state.counters["median_us"] = each_us[kSets / 2];
  state.counters["p99_us"] = each_us[kSets * 99 / 100];
  state.counters["max_us"] = each_us.back();
}

std::vector<Scene> scenes() {
  const PixelBox frame{0, 0, 640, 480};
  const PixelBox window{150, 100, 340, 280};
  std::vector<Scene> all;
  for (const int pairs : {60, 200}) {
    for (const double share : {0.0, 0.1, 0.2, 0.3, 0.5, 0.8}) {
      const std::string size =
          std::to_string(pairs) + "/" + std::to_string(int(std::lround(100 * share))) + "%";
      all.push_back({pairs, share, test::LinearMap::Affine, frame, size + "/frame"});
      all.push_back({pairs, share, test::LinearMap::Affine, window, size + "/window"});
      all.push_back({pairs, share, test::LinearMap::Similarity, frame, size + "/similarity"});
    }
  }
  return all;
}

void register_all() {
  const std::vector<std::pair<std::string, Method>> methods = {
      {"truth", by_truth},
      {"votes", by_votes},
      {"ransac", by_ransac},
      {"cv_ransac", [](const PlantedSet& s) { return by_opencv(s, cv::RANSAC); }},
      {"cv_magsac", [](const PlantedSet& s) { return by_opencv(s, cv::USAC_MAGSAC); }},
      {"cv_usac", [](const PlantedSet& s) { return by_opencv(s, cv::USAC_DEFAULT); }},
      {"cv_accurate", [](const PlantedSet& s) { return by_opencv(s, cv::USAC_ACCURATE); }},
  };
  for (const Scene& scene : scenes()) {
    for (const auto& [name, method] : methods) {
      benchmark::RegisterBenchmark((scene.name + "/" + name).c_str(), [scene = scene,
                                                                       method = method](
                                                                          benchmark::State& s) {
        measure(s, scene, method);
      })->Unit(benchmark::kMicrosecond);
    }
  }
}

}  // namespace
}  // namespace kestrel

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  kestrel::register_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

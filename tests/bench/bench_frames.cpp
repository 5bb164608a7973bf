#include "bench/bench_frames.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "bench/stress.hpp"

namespace kestrel::test {
namespace {

constexpr int kCropPx = 256;

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

double seconds(const FrameWork& work, std::size_t k) {
  const double start_s = thread_cpu_s();
  work(k);
  return thread_cpu_s() - start_s;
}

/// The smallest value that this share of them does not exceed.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto rank = std::size_t(std::ceil(share * double(values.size())));
  return values[std::max<std::size_t>(rank, 1) - 1];
}

/// Left or top of a crop about a centre, px, inside the image.
int start_of_crop(double centre, int length) {
  return std::clamp(int(std::lround(centre)) - kCropPx / 2, 0, length - kCropPx);
}

Homography shifted(double du, double dv, const Homography& H) {
  Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
  shift(0, 2) = du;
  shift(1, 2) = dv;
  return {shift * H.H};
}

BenchFrames rendered() {
  const StressSequence sequence = stress_sequence({"nominal", "graffiti", 60, 1});
  BenchFrames result;
  result.template_px = sequence.sequence.template_px;
  for (const cv::Mat& gray : rendered_frames(sequence)) {
    const auto k = std::int64_t(result.frames.size());
    result.frames.push_back({k, double(k) / 30, gray, {}});
    result.truth.push_back(homography_from_outline(sequence.sequence.truth.at(k),
                                                   result.template_px.width,
                                                   result.template_px.height)
                               .value());
  }
  return result;
}

BenchFrames cropped(BenchFrames result) {
  for (std::size_t k = 0; k < result.frames.size(); ++k) {
    cv::Mat& gray = result.frames[k].gray;
    const Pixel middle = result.truth[k] * Pixel{(result.template_px.width - 1) / 2,
                                                 (result.template_px.height - 1) / 2};
    const int left = start_of_crop(middle.u, gray.cols);
    const int top = start_of_crop(middle.v, gray.rows);
    gray = gray(cv::Rect(left, top, kCropPx, kCropPx)).clone();
    result.truth[k] = shifted(-left, -top, result.truth[k]);
    if (k > 0) continue;
    result.template_px.u -= left;
    result.template_px.v -= top;
  }
  return result;
}

}  // namespace

const BenchFrames& whole_frames() {
  static const BenchFrames kFrames = rendered();
  return kFrames;
}

const BenchFrames& cropped_frames() {
  static const BenchFrames kFrames = cropped(whole_frames());
  return kFrames;
}

void time_frames(benchmark::State& state, std::size_t frames, const FrameWork& prepare,
                 const FrameWork& work, int repeats) {
  std::vector<double> each_us;
  std::size_t k = 0;
  for ([[maybe_unused]] auto _ : state) {
    prepare(k);
    const double took_s = seconds(
        [&](std::size_t frame) {
          for (int i = 0; i < repeats; ++i) work(frame);
        },
        k);
    state.SetIterationTime(took_s / repeats);
    each_us.push_back(1e6 * took_s / repeats);
    k = (k + 1) % frames;
  }
  state.counters["median_us"] = quantile(each_us, 0.5);
  state.counters["p99_us"] = quantile(each_us, 0.99);
}

void time_beside(benchmark::State& state, std::size_t frames,
                 const std::function<FrameWork()>& begin_theirs,
                 const std::function<FrameWork()>& begin_ours) {
  std::vector<double> ours_us;
  std::vector<double> theirs_us;
  const auto pass = [&](const FrameWork& work, std::vector<double>& each_us) {
    double sum_s = 0;
    for (std::size_t k = 0; k < frames; ++k) {
      const double took_s = seconds(work, k);
      each_us.push_back(1e6 * took_s);
      sum_s += took_s;
    }
    return sum_s;
  };
  for ([[maybe_unused]] auto _ : state) {
    const FrameWork theirs = begin_theirs();
    state.SetIterationTime(pass(theirs, theirs_us) / double(frames));
    const FrameWork ours = begin_ours();
    pass(ours, ours_us);
  }
  const double ours = quantile(ours_us, 0.5);
  state.counters["median_us"] = quantile(theirs_us, 0.5);
  state.counters["p99_us"] = quantile(theirs_us, 0.99);
  state.counters["ours_us"] = ours;
  state.counters["times_ours"] = ours > 0 ? quantile(theirs_us, 0.5) / ours : 0;
}

}  // namespace kestrel::test

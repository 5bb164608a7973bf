#include "bench/stress_score.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <exception>
#include <limits>

namespace kestrel::test {
namespace {

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

double error_px(const Homography& image_from_template, const PixelBox& box, const Corners& truth) {
  const auto corners = outline(image_from_template, box.width, box.height);
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += distance(corners[i], truth[i]) / 4;
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

std::optional<double> quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(share * double(values.size()));
  return values[std::size_t(std::max(1., rank)) - 1];
}

ScoredFrame judged(const BenchAnswer& answer, const StressSequence& sequence, std::int64_t frame) {
  ScoredFrame result;
  const auto row = sequence.sequence.truth.find(frame);
  result.is_labelled = row != sequence.sequence.truth.end();
  result.is_absent = sequence.absent.count(frame) > 0;
  result.is_found = answer.image_from_template.has_value();
  if (result.is_labelled && result.is_found) {
    result.error_px =
        error_px(*answer.image_from_template, sequence.sequence.template_px, row->second);
  }
  return result;
}

}  // namespace

std::vector<ScoredFrame> scored(const BenchMethod& method, const StressSequence& sequence,
                                const std::vector<cv::Mat>& frames) {
  std::vector<ScoredFrame> result;
  BenchTracker track;
  try {
    track = method.learn(frames.at(0), sequence.sequence.template_px);
  } catch (const std::exception&) {
    track = [](const Frame&) { return BenchAnswer{}; };
  }
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Frame frame{std::int64_t(k), double(k) / 30, frames[k], {}};
    const double start_s = cpu_s();
    const BenchAnswer answer = track(frame);
    const double end_s = cpu_s();
    result.push_back(judged(answer, sequence, frame.index));
    result.back().cpu_ms = 1e3 * (end_s - start_s);
  }
  return result;
}

ScoreLine score_line(const std::vector<ScoredFrame>& frames) {
  ScoreLine line;
  std::vector<double> errors;
  std::vector<double> times;
  int wrong = 0;
  for (const ScoredFrame& frame : frames) {
    line.labelled += frame.is_labelled ? 1 : 0;
    line.absent += frame.is_absent ? 1 : 0;
    times.push_back(frame.cpu_ms);
    wrong += frame.is_absent && frame.is_found ? 1 : 0;
    if (!frame.error_px) continue;
    errors.push_back(*frame.error_px);
    wrong += *frame.error_px > kWrongPx ? 1 : 0;
  }
  const auto within = [&](double px) {
    const auto n = std::count_if(errors.begin(), errors.end(), [&](double e) { return e <= px; });
    return line.labelled > 0 ? double(n) / line.labelled : 0;
  };
  line.ok3 = within(3);
  line.ok5 = within(5);
  line.wrong = line.labelled + line.absent > 0 ? double(wrong) / (line.labelled + line.absent) : 0;
  line.median_px = quantile(errors, 0.5);
  line.p95_px = quantile(errors, 0.95);
  line.median_ms = quantile(times, 0.5);
  line.p95_ms = quantile(times, 0.95);
  line.max_ms = quantile(times, 1);
  return line;
}

}  // namespace kestrel::test

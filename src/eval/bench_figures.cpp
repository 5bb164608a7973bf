#include "bench_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kestrel/io/svg_plot.hpp"

namespace kestrel {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kMilli = 1e-3;

/// The colour of a method, the same in every plot; empty when it is not drawn.
std::optional<int> colour(const std::string& method, const std::vector<MethodScore>& methods) {
  for (std::size_t i = 0; i < std::min(methods.size(), kMostCurves); ++i) {
    if (methods[i].method == method) return int(i);
  }
  return std::nullopt;
}

/// Mean over the judged sequences of a method's precision curve, %.
std::vector<double> curve_of(const std::string& method, const std::vector<SequencePart>& parts,
                             const std::vector<double>& limits_px) {
  std::vector<double> sum(limits_px.size(), 0);
  int count = 0;
  for (const SequencePart& part : parts) {
    for (std::size_t i = 0; i < part.runs.size(); ++i) {
      if (part.runs[i].method != method || !part.scores[i].is_judged) continue;
      ++count;
      const auto scores =
          frame_scores(judged_by(part.sequence->truth, part.runs[i]), estimate_of(part.runs[i]));
      const auto curve = precision(scores, limits_px);
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += 100 * curve[k];
    }
  }
  for (double& value : sum) value = count > 0 ? value / count : kNone;
  return sum;
}

/// The frames' times of a method, sorted, ms.
std::vector<double> sorted_times(const std::string& method,
                                 const std::vector<SequencePart>& parts) {
  std::vector<double> times_ms;
  for (const SequencePart& part : parts) {
    for (const BenchRun& run : part.runs) {
      if (run.method != method) continue;
      for (const BenchFrame& frame : run.frames) times_ms.push_back(frame.time_s / kMilli);
    }
  }
  std::sort(times_ms.begin(), times_ms.end());
  return times_ms;
}

/// What each frame of a run gives, over its number.
template <class Value>
Series series_of(const BenchRun& run, int colour, Value value) {
  Series series{run.method, {}, {}, colour};
  for (const BenchFrame& frame : run.frames) {
    series.x.push_back(double(frame.frame));
    series.y.push_back(value(frame));
  }
  return series;
}

/// Labelled frames are joined over a few that are not; a frame not found breaks the line, as does a
/// stretch without labels.
Series error_series(const SequencePart& part, const BenchRun& run, int colour) {
  constexpr double kLeast_px = 0.01;  // a logarithmic axis has no zero
  constexpr std::int64_t kBridged = 10;
  Series series{run.method, {}, {}, colour};
  const auto put = [&](std::int64_t frame, double error_px) {
    series.x.push_back(double(frame));
    series.y.push_back(error_px);
  };
  std::int64_t last = 0;
  for (const FrameScore& score :
       frame_scores(judged_by(part.sequence->truth, run), estimate_of(run))) {
    if (score.frame - last > kBridged) put(last, kNone);
    put(score.frame, score.error_px ? std::max(*score.error_px, kLeast_px) : kNone);
    last = score.frame;
  }
  return series;
}

}  // namespace

std::string precision_plot(const std::vector<MethodScore>& methods,
                           const std::vector<SequencePart>& parts) {
  std::vector<double> limits_px;
  for (int i = 0; i <= 100; ++i) limits_px.push_back(i / 10.0);
  Plot plot;
  plot.title = "Frames within an error";
  plot.x_label = "mean corner error allowed (px)";
  plot.y_label = "labelled frames (%)";
  plot.when_empty = "no sequence has labels";
  for (std::size_t i = 0; i < std::min(methods.size(), kMostCurves); ++i) {
    const std::string& method = methods[i].method;
    plot.series.push_back({method, limits_px, curve_of(method, parts, limits_px), int(i)});
  }
  return svg_plot(plot);
}

std::string times_plot(const std::vector<MethodScore>& methods,
                       const std::vector<SequencePart>& parts) {
  Plot plot;
  plot.title = "Processor time of a frame, sorted";
  plot.x_label = "frames that take no longer (%)";
  plot.y_label = "time (ms)";
  plot.y_spacing = Spacing::Logarithmic;
  for (std::size_t i = 0; i < std::min(methods.size(), kMostCurves); ++i) {
    Series series{methods[i].method, {}, sorted_times(methods[i].method, parts), int(i)};
    for (std::size_t k = 0; k < series.y.size(); ++k) {
      series.x.push_back(100.0 * double(k + 1) / double(series.y.size()));
    }
    plot.series.push_back(std::move(series));
  }
  return svg_plot(plot);
}

std::string error_plot(const SequencePart& part, const std::vector<MethodScore>& methods) {
  Plot plot;
  plot.title = "Mean corner error";
  plot.x_label = "frame (no line: not found, or no label)";
  plot.y_label = "error (px)";
  plot.y_spacing = Spacing::Logarithmic;
  plot.when_empty = "no labelled frame was found";
  plot.limits = {{kWrongPx, "wrong above"}};
  for (const BenchRun& run : part.runs) {
    if (const auto c = colour(run.method, methods)) {
      plot.series.push_back(error_series(part, run, *c));
    }
  }
  return svg_plot(plot);
}

std::string time_plot(const SequencePart& part, const std::vector<MethodScore>& methods) {
  Plot plot;
  plot.title = "Processor time";
  plot.x_label = "frame";
  plot.y_label = "time (ms)";
  plot.y_spacing = Spacing::Logarithmic;
  for (const BenchRun& run : part.runs) {
    const auto c = colour(run.method, methods);
    if (!c) continue;
    plot.series.push_back(
        series_of(run, *c, [](const BenchFrame& f) { return f.time_s / kMilli; }));
  }
  return svg_plot(plot);
}

}  // namespace kestrel

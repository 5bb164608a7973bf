#include "kestrel/eval/bench_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "kestrel/eval/bench_score.hpp"
#include "kestrel/io/overlay.hpp"

namespace kestrel {
namespace {

/// A picture that is wanted of a frame.
struct Wanted {
  std::size_t run = 0;
  std::size_t rank = 0;  // 0: the worst
  const BenchFrame* frame = nullptr;
  std::optional<double> error_px;
};

/// Larger is worse: wrong by its error, not found as the limit of wrong.
double badness(const FrameScore& score) { return score.error_px.value_or(kWrongPx); }

Miss miss_of(const BenchAnswer& answer) {
  if (answer.image_from_template) return Miss::None;
  for (const Miss miss :
       {Miss::NoImage, Miss::FewKeypoints, Miss::FewMatches, Miss::NoConsensus, Miss::BadOutline}) {
    if (answer.state == name(miss)) return miss;
  }
  return Miss::Undetermined;
}

Track track_of(const BenchAnswer& answer) {
  Track track;
  track.image_from_template = answer.image_from_template;
  track.miss = miss_of(answer);
  track.window = answer.window;
  track.keypoints = answer.keypoints;
  track.matches = answer.matches;
  return track;
}

std::string caption(const BenchFrame& frame, const std::optional<double>& error_px) {
  if (!error_px) return fmt::format("frame {}: not found ({})", frame.frame, frame.answer.state);
  return fmt::format("frame {}: {:.1f} px off", frame.frame, *error_px);
}

/// The pictures wanted of all runs, by frame.
std::multimap<std::int64_t, Wanted> wanted_of(const BenchSequence& sequence,
                                              const std::vector<BenchRun>& runs, int count) {
  constexpr double kWorth_px = 2;
  std::multimap<std::int64_t, Wanted> wanted;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto scores = frame_scores(judged_by(sequence.truth, runs[r]), estimate_of(runs[r]));
    std::map<std::int64_t, std::optional<double>> errors;
    for (const FrameScore& score : scores) errors[score.frame] = score.error_px;
    const auto worst = worst_frames(scores, count, kWorth_px);
    for (std::size_t rank = 0; rank < worst.size(); ++rank) {
      for (const BenchFrame& frame : runs[r].frames) {
        if (frame.frame != worst[rank]) continue;
        wanted.emplace(frame.frame, Wanted{r, rank, &frame, errors[frame.frame]});
      }
    }
  }
  return wanted;
}

/// The template's picture; empty when the rectangle is not in the image.
cv::Mat template_picture(const cv::Mat& gray, const PixelBox& box) {
  const PixelBox part = clipped(box, gray.cols, gray.rows);
  const cv::Rect rectangle(int(part.u), int(part.v), int(part.width), int(part.height));
  return gray.empty() || rectangle.empty() ? cv::Mat() : gray(rectangle).clone();
}

}  // namespace

std::vector<std::int64_t> worst_frames(const std::vector<FrameScore>& scores, int count,
                                       double worth_px) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (badness(scores[i]) > worth_px) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return badness(scores[a]) > badness(scores[b]);
  });
  const std::size_t apart = scores.size() / 20;
  std::vector<std::size_t> taken;
  for (const std::size_t i : order) {
    if (taken.size() >= std::size_t(std::max(count, 0))) break;
    const bool is_near = std::any_of(taken.begin(), taken.end(), [&](std::size_t other) {
      return (i > other ? i - other : other - i) < apart;
    });
    if (!is_near) taken.push_back(i);
  }
  std::vector<std::int64_t> frames;
  frames.reserve(taken.size());
  for (const std::size_t i : taken) frames.push_back(scores[i].frame);
  return frames;
}

std::vector<std::vector<ReportPicture>> worst_pictures(const BenchSequence& sequence,
                                                       const std::vector<BenchRun>& runs,
                                                       int count) {
  std::vector<std::vector<ReportPicture>> pictures(runs.size());
  const auto wanted = wanted_of(sequence, runs, count);
  if (wanted.empty()) return pictures;
  std::vector<std::map<std::size_t, ReportPicture>> ranked(runs.size());
  try {
    const auto source = sequence.open();
    cv::Mat learned;
    for (auto frame = source->next(); frame; frame = source->next()) {
      if (learned.empty()) learned = template_picture(frame->gray, sequence.template_px);
      const auto [begin, end] = wanted.equal_range(frame->index);
      for (auto one = begin; one != end; ++one) {
        const Wanted& w = one->second;
        OverlayOptions options;
        options.goal_corners = sequence.truth.at(frame->index);
        ranked[w.run][w.rank] =
            report_picture(caption(*w.frame, w.error_px),
                           overlay(*frame, learned, track_of(w.frame->answer), options));
      }
      if (frame->index >= wanted.rbegin()->first) break;
    }
  } catch (const std::exception&) {  // the scores stand without pictures
    return pictures;
  }
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (auto& entry : ranked[r]) pictures[r].push_back(std::move(entry.second));
  }
  return pictures;
}

}  // namespace kestrel

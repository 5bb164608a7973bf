// The tracker with its default options on real sequences with ground truth.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <map>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "kestrel/vision/tracker.hpp"

#include "support/shared_sequence.hpp"

namespace kestrel {
namespace {

constexpr std::array<TrackMethod, 3> kMethods{TrackMethod::Paper, TrackMethod::Detect,
                                              TrackMethod::Hybrid};

TrackOptions options_of(TrackMethod method) {
  TrackOptions options;
  options.method = method;
  return options;
}

struct Score {
  int frames = 0;
  int found = 0;
  int labelled = 0;
  std::vector<double> errors_px;  // of the labelled frames reported found
  std::vector<double> times_ms;
  std::map<std::string, int> misses;
  int unseen_after_gap = 0;  // labelled frames without the target after the longest gap of labels

  int within(double px) const {
    return int(std::count_if(errors_px.begin(), errors_px.end(), [&](double e) { return e < px; }));
  }
  double worst_px() const {
    return errors_px.empty() ? 0 : *std::max_element(errors_px.begin(), errors_px.end());
  }
};

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double percent(int part, int whole) { return whole > 0 ? 100.0 * part / whole : 0; }

/// The first labelled frame after the longest stretch without labels.
std::int64_t end_of_gap(const test::SharedSequence& sequence) {
  std::int64_t before = sequence.first_frame;
  std::int64_t longest = 0;
  std::int64_t end = sequence.first_frame;
  for (const auto& [frame, corners] : sequence.truth) {
    if (frame - before > longest) {
      longest = frame - before;
      end = frame;
    }
    before = frame;
  }
  return end;
}

/// The frame of that place in the sequence, on the clock of a camera of 30 frames a second.
Frame frame_of(const test::SharedSequence& sequence, std::size_t i) {
  Frame frame;
  frame.index = std::int64_t(i);
  frame.stamp_s = double(i) / 30;
  frame.gray = sequence.frames[i];
  return frame;
}

void count(const test::SharedSequence& sequence, std::int64_t number, const Track& seen,
           Score& score) {
  ++score.frames;
  score.labelled += sequence.truth.count(number) > 0 ? 1 : 0;
  if (!seen.found()) {
    ++score.misses[name(seen.miss)];
    return;
  }
  ++score.found;
  const auto error = corner_error_px(sequence, number, *seen.image_from_template);
  if (!error) return;
  score.errors_px.push_back(*error);
  if (*error > 10) {
    std::printf("  frame %lld: %.1f px off, %s, confidence %.2f\n", static_cast<long long>(number),
                *error, name(seen.stage), seen.confidence);
  }
}

Score scored(const test::SharedSequence& sequence, TrackMethod method) {
  const cv::Mat& first = sequence.frames.front();
  Tracker tracker(first, sequence.template_box, options_of(method));
  TrackState state = tracker.start(first.cols, first.rows);
  const std::int64_t end = end_of_gap(sequence);
  bool is_waiting = true;
  Score score;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const std::int64_t number = sequence.first_frame + std::int64_t(i);
    const auto start = std::chrono::steady_clock::now();
    const Track seen = tracker.track(frame_of(sequence, i), state);
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    score.times_ms.push_back(taken.count());
    state = seen.next;
    count(sequence, number, seen, score);
    if (number >= end && seen.found()) is_waiting = false;
    if (number >= end && is_waiting) score.unseen_after_gap += int(sequence.truth.count(number));
  }
  return score;
}

void print(const std::string& sequence, TrackMethod method, const Score& s) {
  std::printf("%-16s %-6s frames %3d found %5.1f%% labelled %3d found %5.1f%% within 5 px %5.1f%% ",
              sequence.c_str(), name(method), s.frames, percent(s.found, s.frames), s.labelled,
              percent(int(s.errors_px.size()), s.labelled), percent(s.within(5), s.labelled));
  std::printf("over 10 px %d median error %.2f px worst %.2f px median %.2f ms worst %.1f ms",
              int(s.errors_px.size()) - s.within(10), median(s.errors_px), s.worst_px(),
              median(s.times_ms), *std::max_element(s.times_ms.begin(), s.times_ms.end()));
  for (const auto& [why, times] : s.misses) std::printf(" %s %d", why.c_str(), times);
  std::printf("\n");
  std::fflush(stdout);
}

constexpr std::array<const char*, 4> kPlain{"apt_vcube_comic", "bruegel", "postcard_a",
                                            "mural_tree"};

/// What is asked of a method on a sequence.
struct Demand {
  const char* sequence;
  TrackMethod method;
  double within_5_px_percent;  // at least, of the labelled frames
  double worst_px;             // of all frames reported found
};

void PrintTo(const Demand& demand, std::ostream* out) {
  *out << demand.sequence << " " << name(demand.method);
}

std::string name_of(const testing::TestParamInfo<Demand>& info) {
  return std::string(info.param.sequence) + "_" + name(info.param.method);
}

std::vector<Demand> demands() {
  std::vector<Demand> all;
  for (const char* sequence : kPlain) {
    all.push_back({sequence, TrackMethod::Paper, 98, 10});
    all.push_back({sequence, TrackMethod::Detect, 99, 10});
    all.push_back({sequence, TrackMethod::Hybrid, 99, 10});
  }
  all.push_back({"graf", TrackMethod::Detect, 100.0 * 5 / 6, 20});
  all.push_back({"apt_mire2", TrackMethod::Hybrid, 95, 20});
  all.push_back({"cube_orbit", TrackMethod::Hybrid, 95, 20});
  for (const char* sequence : {"mural_pilot", "pot_V25_2", "uav_marina", "witch_screen"}) {
    all.push_back({sequence, TrackMethod::Hybrid, 95, 20});
  }
  // A chessboard is like itself two squares along: to see nothing is no fault, to be wrong is one.
  all.push_back({"apt_chess_left", TrackMethod::Detect, 0, 20});
  all.push_back({"apt_chess_left", TrackMethod::Hybrid, 0, 20});
  return all;
}

class GoldenTrack : public testing::TestWithParam<Demand> {};

TEST_P(GoldenTrack, FindsTheTargetAndIsNeverFarOff) {
  const Demand& demand = GetParam();
  const test::SharedData data = test::load_shared(demand.sequence);
  if (!data.sequence) GTEST_SKIP() << data.why_not;
  const Score score = scored(*data.sequence, demand.method);
  print(demand.sequence, demand.method, score);
  EXPECT_GT(score.labelled, 0);
  EXPECT_GE(percent(score.within(5), score.labelled), demand.within_5_px_percent);
  EXPECT_LE(score.worst_px(), demand.worst_px);
  EXPECT_LE(score.unseen_after_gap, 10);
}

INSTANTIATE_TEST_SUITE_P(Sequences, GoldenTrack, testing::ValuesIn(demands()), name_of);

class GoldenAbsence : public testing::TestWithParam<TrackMethod> {};

TEST_P(GoldenAbsence, IsNeverTakenForTheTarget) {
  // Every 20th frame of the other sequences, searched as a whole for this one's template.
  std::vector<test::SharedSequence> sequences;
  for (const char* which : kPlain) {
    const test::SharedData data = test::load_shared(which);
    if (!data.sequence) GTEST_SKIP() << data.why_not;
    sequences.push_back(*data.sequence);
  }
  int searched = 0;
  for (std::size_t t = 0; t < sequences.size(); ++t) {
    Tracker tracker(sequences[t].frames.front(), sequences[t].template_box, options_of(GetParam()));
    for (std::size_t s = 0; s < sequences.size(); ++s) {
      for (std::size_t i = 0; s != t && i < sequences[s].frames.size(); i += 20, ++searched) {
        const Frame frame = frame_of(sequences[s], i);
        TrackState everywhere = tracker.start(frame.gray.cols, frame.gray.rows);
        everywhere.window = {0, 0, double(frame.gray.cols), double(frame.gray.rows)};
        EXPECT_FALSE(tracker.track(frame, everywhere).found())
            << kPlain[t] << " in " << kPlain[s] << " frame " << i;
      }
    }
  }
  std::printf("absent targets, %s: none may be found in %d frames\n", name(GetParam()), searched);
}

INSTANTIATE_TEST_SUITE_P(Methods, GoldenAbsence, testing::ValuesIn(kMethods),
                         [](const auto& method) { return std::string(name(method.param)); });

/// Prints the table of all sequences; run with --gtest_also_run_disabled_tests.
class GoldenTable : public testing::TestWithParam<const char*> {};

TEST_P(GoldenTable, DISABLED_IsPrinted) {
  const test::SharedData data = test::load_shared(GetParam());
  if (!data.sequence) GTEST_SKIP() << data.why_not;
  for (const TrackMethod method : kMethods) {
    try {
      print(GetParam(), method, scored(*data.sequence, method));
    } catch (const std::invalid_argument& refusal) {
      std::printf("%-16s %-6s %s\n", GetParam(), name(method), refusal.what());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sequences, GoldenTable,
                         testing::Values("apt_chess_left", "apt_mire2", "apt_vcube_comic",
                                         "bruegel", "cube_orbit", "graf", "mural_pilot",
                                         "mural_tree", "postcard_a", "pot_V25_2", "uav_marina",
                                         "witch_screen"),
                         [](const auto& sequence) { return std::string(sequence.param); });

}  // namespace
}  // namespace kestrel

// The tracker with its default options on real sequences with ground truth.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "kestrel/vision/track.hpp"

#include "support/shared_sequence.hpp"

namespace kestrel {
namespace {

struct Score {
  int frames = 0;
  int found = 0;
  int labelled = 0;
  int found_labelled = 0;
  int within_5_px = 0;
  int over_10_px = 0;
  std::vector<double> errors_px;  // of the labelled frames reported found
  std::vector<double> times_ms;
  std::map<std::string, int> misses;
};

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void count(const Track& seen, std::optional<double> error_px, bool has_label, Score& score) {
  ++score.frames;
  score.labelled += has_label ? 1 : 0;
  if (!seen.found()) {
    ++score.misses[name(seen.miss)];
    return;
  }
  ++score.found;
  if (!error_px) return;
  ++score.found_labelled;
  score.within_5_px += *error_px < 5 ? 1 : 0;
  score.over_10_px += *error_px > 10 ? 1 : 0;
  score.errors_px.push_back(*error_px);
}

Score scored(const test::SharedSequence& sequence) {
  const TrackOptions options;
  const cv::Mat& first = sequence.frames.front();
  const Template model(first, sequence.template_box, options.sift, options.match);
  TrackState state = start_tracking(model, first.cols, first.rows);
  Score score;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const std::int64_t number = sequence.first_frame + std::int64_t(i);
    Frame frame;
    frame.index = std::int64_t(i);
    frame.gray = sequence.frames[i];
    const auto start = std::chrono::steady_clock::now();
    const Track seen = track(model, frame, state, options);
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    score.times_ms.push_back(taken.count());
    state = seen.next;
    std::optional<double> error;
    if (seen.found()) error = corner_error_px(sequence, number, *seen.image_from_template);
    if (error && *error > 10) {
      std::printf("  frame %lld: %.1f px off, %zu inliers of %d matches\n",
                  static_cast<long long>(number), *error, seen.inliers.size(), seen.matches);
    }
    count(seen, error, sequence.truth.count(number) > 0, score);
  }
  return score;
}

double percent(int part, int whole) { return whole > 0 ? 100.0 * part / whole : 0; }

void print(const std::string& name, const Score& s) {
  std::printf("%-16s frames %3d found %5.1f%% labelled %3d found %5.1f%% within 5 px %5.1f%% ",  //
              name.c_str(), s.frames, percent(s.found, s.frames), s.labelled,
              percent(s.found_labelled, s.labelled), percent(s.within_5_px, s.labelled));
  std::printf("over 10 px %d median error %.2f px worst %.2f px median %.1f ms worst %.1f ms",
              s.over_10_px, median(s.errors_px),
              s.errors_px.empty() ? 0 : *std::max_element(s.errors_px.begin(), s.errors_px.end()),
              median(s.times_ms), *std::max_element(s.times_ms.begin(), s.times_ms.end()));
  for (const auto& [why, times] : s.misses) std::printf(" %s %d", why.c_str(), times);
  std::printf("\n");
  std::fflush(stdout);
}

constexpr std::array<const char*, 4> kAsserted{"apt_vcube_comic", "bruegel", "postcard_a",
                                               "mural_tree"};

class GoldenTrack : public testing::TestWithParam<const char*> {};

TEST_P(GoldenTrack, FindsTheTargetAndIsNeverFarOff) {
  const test::SharedData data = test::load_shared(GetParam());
  if (!data.sequence) GTEST_SKIP() << data.why_not;
  const Score score = scored(*data.sequence);
  print(GetParam(), score);
  EXPECT_GT(score.labelled, 0);
  EXPECT_GE(percent(score.within_5_px, score.labelled), 98);
  EXPECT_EQ(score.over_10_px, 0);
}

INSTANTIATE_TEST_SUITE_P(Sequences, GoldenTrack, testing::ValuesIn(kAsserted),
                         [](const auto& sequence) { return std::string(sequence.param); });

TEST(GoldenAbsence, IsNeverTakenForTheTarget) {
  // Every 20th frame of the other sequences, searched as a whole for this one's template.
  std::vector<test::SharedSequence> sequences;
  for (const char* which : kAsserted) {
    const test::SharedData data = test::load_shared(which);
    if (!data.sequence) GTEST_SKIP() << data.why_not;
    sequences.push_back(*data.sequence);
  }
  const TrackOptions options;
  int searched = 0;
  for (std::size_t t = 0; t < sequences.size(); ++t) {
    const Template model(sequences[t].frames.front(), sequences[t].template_box, options.sift,
                         options.match);
    for (std::size_t s = 0; s < sequences.size(); ++s) {
      for (std::size_t i = 0; s != t && i < sequences[s].frames.size(); i += 20, ++searched) {
        const cv::Mat& gray = sequences[s].frames[i];
        Frame frame;
        frame.index = std::int64_t(i);
        frame.gray = gray;
        const TrackState everywhere{{0, 0, double(gray.cols), double(gray.rows)}};
        EXPECT_FALSE(track(model, frame, everywhere, options).found())
            << kAsserted[t] << " in " << kAsserted[s] << " frame " << i;
      }
    }
  }
  std::printf("absent targets: none found in %d frames\n", searched);
}

/// Prints the table of all sequences; run with --gtest_also_run_disabled_tests.
class GoldenTable : public testing::TestWithParam<const char*> {};

TEST_P(GoldenTable, DISABLED_IsPrinted) {
  const test::SharedData data = test::load_shared(GetParam());
  if (!data.sequence) GTEST_SKIP() << data.why_not;
  try {
    print(GetParam(), scored(*data.sequence));
  } catch (const std::invalid_argument& refusal) {
    std::printf("%-16s %s\n", GetParam(), refusal.what());
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

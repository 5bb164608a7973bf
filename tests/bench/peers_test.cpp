#include "bench/peers.hpp"

#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "bench/methods.hpp"
#include "bench/stress.hpp"
#include "bench/stress_score.hpp"
#include "bench/stress_texture.hpp"

namespace kestrel::test {
namespace {

ScoredFrame labelled(double error_px, double cpu_ms) {
  ScoredFrame frame;
  frame.is_labelled = true;
  frame.is_found = true;
  frame.error_px = error_px;
  frame.cpu_ms = cpu_ms;
  return frame;
}

TEST(StressScore, CountsWhatIsRightWrongAndMissed) {
  std::vector<ScoredFrame> frames{labelled(0.1, 1), labelled(4, 2), labelled(11, 3)};
  frames.emplace_back();
  frames.back().is_labelled = true;  // not found
  for (const bool is_found : {true, false}) {
    frames.emplace_back();
    frames.back().is_absent = true;
    frames.back().is_found = is_found;
  }
  const ScoreLine line = score_line(frames);
  EXPECT_EQ(line.labelled, 4);
  EXPECT_EQ(line.absent, 2);
  EXPECT_DOUBLE_EQ(line.ok3, 0.25);
  EXPECT_DOUBLE_EQ(line.ok5, 0.5);
  EXPECT_DOUBLE_EQ(line.wrong, 2 / 6.);  // 11 px off, and found where nothing is
  EXPECT_DOUBLE_EQ(line.median_px.value(), 4);
  EXPECT_DOUBLE_EQ(line.p95_px.value(), 11);
  EXPECT_DOUBLE_EQ(line.max_ms.value(), 3);
  EXPECT_FALSE(score_line({}).median_ms.has_value());
}

class Peers : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(stress_texture("graffiti").file)) {
      GTEST_SKIP() << "opencv-doc is not installed";
    }
  }
};

/// A gentle motion is nobody's limit: every method follows it. Bounds: template trackers work on
/// all pixels; SIFT places keypoints to a few tenths of a pixel, of which a hundred average; ORB's
/// are whole pixels of its levels. An answer in other coordinates (a corner for a centre, a
/// keypoint's bias left in) is half a pixel off or more.
TEST_F(Peers, FollowAGentleMotion) {
  const StressSequence sequence = stress_sequence({"nominal", "graffiti", 5, 1});
  const std::vector<cv::Mat> frames = rendered_frames(sequence);
  for (const BenchMethod& method : bench_methods()) {
    const ScoreLine line = score_line(scored(method, sequence, frames));
    const bool is_binary = method.name == "cv_orb" || method.name == "cv_akaze";
    EXPECT_EQ(line.ok3, 1) << method.name;
    EXPECT_LT(line.median_px.value_or(99), is_binary ? 2 : 0.2) << method.name;
  }
}

TEST_F(Peers, FindNothingInAFrameWithoutPicture) {
  const StressSequence sequence = stress_sequence({"nominal", "graffiti", 1, 1});
  const cv::Mat learned = rendered_frames(sequence).front();
  const Frame grey{1, 1 / 30., cv::Mat(480, 640, CV_8U, cv::Scalar(128)), {}};
  for (const BenchMethod& method : bench_methods()) {
    if (method.name.find("visp_template") == 0) continue;  // they never say that they are lost
    const BenchTracker track = method.learn(learned, sequence.sequence.template_px);
    EXPECT_FALSE(track(grey).image_from_template.has_value()) << method.name;
  }
}

TEST_F(Peers, AreChosenByName) {
  EXPECT_EQ(bench_methods({"paper"}).size(), 1u);
  EXPECT_EQ(bench_methods(std::vector<std::string>{}).size(), bench_methods().size());
  EXPECT_THROW(bench_methods({"nobody"}), std::invalid_argument);
  std::set<std::string> names;
  for (const BenchMethod& method : bench_methods()) names.insert(method.name);
  EXPECT_EQ(names.size(), bench_methods().size());
}

}  // namespace
}  // namespace kestrel::test

// What the program takes of a small computer's memory: asserted, since memory is not time.
#include <filesystem>

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "kestrel/io/video_writer.hpp"
#include "kestrel/sim/texture.hpp"

#include "cli/program.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

constexpr double kPromised_bytes = 120e6;
constexpr int kFrames = 60;  // more than the decoder, the encoder and the contact sheet hold

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

/// A textured wall that moves by a pixel a frame, 640x480; the extension says H.264 or Motion JPEG.
void wall_video(const std::filesystem::path& path) {
  const cv::Mat wall = poster(640 + kFrames, 480, 5);
  VideoWriter video(path, 30);
  for (int i = 0; i < kFrames; ++i) video.write(wall(cv::Rect(i, 0, 640, 480)));
  video.close();
}

class Memory : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "the sanitizers' own memory counts too";
    wall_video(folder_ / GetParam());
  }
  /// The most memory that tracking the video takes; extra: options.
  Outcome track(const std::vector<std::string>& extra) {
    std::vector<std::string> words{"track",           GetParam(), "--roi",
                                   "200,120,240,240", "--output", "out"};
    words.insert(words.end(), extra.begin(), extra.end());
    return kestrel(words, folder_.path());
  }
  TempFolder folder_;
};

TEST_P(Memory, OfATrackIsAsPromised) {
  const Outcome outcome = track({});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/run.mp4"));
  EXPECT_LT(outcome.peak_memory_bytes, kPromised_bytes) << outcome.out;
  EXPECT_NE(outcome.out.find("peak memory"), std::string::npos) << outcome.out;
}

TEST_P(Memory, OfATrackWithoutVideoIsAsPromised) {
  const Outcome outcome = track({"--no-video"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_LT(outcome.peak_memory_bytes, kPromised_bytes) << outcome.out;
}

INSTANTIATE_TEST_SUITE_P(Of, Memory, testing::Values("wall.mp4", "wall.avi"),
                         [](const auto& video) { return std::string(video.param).substr(5); });

}  // namespace
}  // namespace kestrel::test

#include "bench/absence.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "bench/stress_texture.hpp"

namespace kestrel::test {
namespace {

class Absence : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(stress_texture("graffiti").file)) {
      GTEST_SKIP() << "opencv-doc is not installed";
    }
  }
};

std::vector<cv::Mat> frames_of(const AbsenceOptions& options) {
  std::vector<cv::Mat> frames;
  const auto source = absence_frames(options);
  while (const auto frame = source->next()) frames.push_back(frame->gray);
  return frames;
}

TEST_F(Absence, FramesRepeatAndDiffer) {
  const std::vector<cv::Mat> some = frames_of({"graffiti", 24, 1});
  const std::vector<cv::Mat> more = frames_of({"graffiti", 30, 1});
  const std::vector<cv::Mat> others = frames_of({"graffiti", 24, 2});
  ASSERT_EQ(some.size(), 24u);
  std::set<std::string> seen;
  int same = 0;
  for (std::size_t k = 0; k < some.size(); ++k) {
    EXPECT_TRUE(has_image({std::int64_t(k), 0, some[k], {}})) << k;
    EXPECT_EQ(cv::norm(some[k], more[k], cv::NORM_INF), 0) << k;
    const bool is_alike =
        some[k].size() == others[k].size() && cv::norm(some[k], others[k], cv::NORM_INF) == 0;
    same += is_alike ? 1 : 0;
    seen.emplace(reinterpret_cast<const char*>(some[k].data), 4000);
  }
  EXPECT_GE(seen.size(), 22u);
  EXPECT_LE(same, 2);
}

/// The picture itself is among the others where it is not absent, and is not where it is.
TEST_F(Absence, TheAbsentSubjectIsNotShown) {
  const AbsencePictures whole = absence_pictures("house");
  for (const char* name : {"graffiti", "comic", "box"}) {
    const cv::Mat picture = load_picture(stress_texture(name).file);
    const auto is_it = [&](const cv::Mat& other) {
      return other.size() == picture.size() && cv::norm(other, picture, cv::NORM_INF) == 0;
    };
    const AbsencePictures without = absence_pictures(name);
    EXPECT_TRUE(std::any_of(whole.pictures.begin(), whole.pictures.end(), is_it)) << name;
    EXPECT_TRUE(std::none_of(without.pictures.begin(), without.pictures.end(), is_it)) << name;
  }
}

TEST_F(Absence, OptionsAreChecked) {
  EXPECT_THROW(absence_frames({"nobody", 1, 1}), std::invalid_argument);
  EXPECT_THROW(absence_frames({"box", 0, 1}), std::invalid_argument);
}

TEST_F(Absence, SubjectsAreNamedOnce) {
  const std::vector<std::string> names = absence_subjects();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
}

}  // namespace
}  // namespace kestrel::test
